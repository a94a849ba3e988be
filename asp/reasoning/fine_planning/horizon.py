"""Plans of exactly so many steps in a compact program, from a control that is grounded once."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from itertools import chain

import clingo
from clingo import Number, Symbol

from asp.language import atom, is_positive
from asp.solving import fact, ground, preparation, solving, theory

MOST_LEVELS = 32_767  # of decisions, that clasp tells apart


class Horizon:
    """The transitions of so many steps; the start and the goal are assumed.

    Of shortest plans the first in the order of declaration is found, as far as clasp tells levels
    of decisions apart: actions beyond step 32,767 / (number of actions) come in any order.
    """

    def __init__(self, program: str, actions: Sequence[str], length: int) -> None:
        """`actions` are the agent actions in the order of declaration."""
        self._length = length
        ranks = [fact("rank", a, n) for n, a in enumerate(actions)]
        ranks.append(fact("ranks", len(actions)))
        constants = {"n": length, "ordered": min(length, MOST_LEVELS // (len(actions) + 1))}
        with preparation():
            self.control = ground([program, theory("incremental_fine_planning")], constants, ranks)
            self.control.ground([("open", [])])
            self._initial = _literals(self.control, "holds", 2)
            self._placed = _literals(self.control, "placed", 1)
            self.control.ground(parts(length))
            # The first call prepares the solver, whatever it is asked.
            with solving(self.control):
                pass
        self._goals: dict[str, int | None] = {}

    def start(self, true: frozenset[str], candidates: Mapping[str, Sequence[str]]) -> list[int]:
        """Assumptions that make these fluents true at step 0 and leave the candidates open.

        Of the candidates for the value of each function (`fine_loc(box)`) one is true; all other
        fluents are false.
        """
        open_ = frozenset(chain(*candidates.values()))
        assumed = [
            number if fluent in true else -number
            for fluent, number in self._initial.items()
            if fluent not in open_
        ]
        return [*assumed, *(self._placed[function] for function in candidates)]

    def plan(self, start: Sequence[int], goal: Iterable[str]) -> tuple[str, ...] | None:
        """The first plan of exactly this length, or None. Raises LimitError."""
        assumptions = [*start]
        for literal in goal:
            number = self._wanted(atom(literal))
            if number is not None:
                assumptions.append(number if is_positive(literal) else -number)
            elif is_positive(literal):
                return None
        with solving(self.control, assumptions) as model:
            return None if model is None else read(model)

    def _wanted(self, fluent: str) -> int | None:
        """The solver's literal of a fluent at the last step; None if it cannot hold."""
        if fluent not in self._goals:
            holds = fact("holds", fluent, self._length)
            found = self.control.symbolic_atoms[holds]
            self._goals[fluent] = None if found is None else found.literal
        return self._goals[fluent]


def _literals(control: clingo.Control, predicate: str, arity: int) -> dict[str, int]:
    """The solver's literals of a predicate's atoms by their first argument."""
    return {
        str(found.symbol.arguments[0]): found.literal
        for found in control.symbolic_atoms.by_signature(predicate, arity)
    }


def parts(length: int) -> list[tuple[str, list[Symbol]]]:
    """The parts of the program that so many steps have, in order."""
    parts: list[tuple[str, list[Symbol]]] = [("state", [Number(0)])]
    for step in range(1, length + 1):
        parts += [("step", [Number(step)]), ("state", [Number(step)])]
    return parts


def read(model: clingo.Model) -> tuple[str, ...]:
    """The actions that occur in a model, in order."""
    steps = sorted((s.arguments[1].number, str(s.arguments[0])) for s in model.symbols(shown=True))
    return tuple(action for _, action in steps)
