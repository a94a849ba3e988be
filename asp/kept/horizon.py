"""One control of a domain's transitions, grounded step by step, asked for plans of any length."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence

import clingo
from clingo import Function, Number, Symbol

from asp.kept.clock import standing_still
from asp.literals import atom, is_positive
from asp.solving import ground, solving, symbol, theory

_MOST_LEVELS = 32_000  # clasp tells 32767 levels of decisions apart


class Horizon:
    """A compact program, grounded once: start, goal and the number of used steps are assumed."""

    def __init__(self, program: str, facts: Iterable[Symbol], actions: Sequence[str]) -> None:
        """`actions` are the agent actions in the order of declaration."""
        ranks = [Function("rank", [symbol(a), Number(n)]) for n, a in enumerate(actions)]
        ranks.append(Function("ranks", [Number(len(actions))]))
        self._ordered = _MOST_LEVELS // (len(actions) + 1)
        self._steps = 0
        self._active: list[int] = []
        self._literals: dict[tuple[str, int], int | None] = {}
        with standing_still():
            texts = [program, theory("kept_fine")]
            constants = {"ordered_steps": self._ordered}
            self.control = ground(texts, constants, [*facts, *ranks])
            self._initial = self._inertial()
            self.control.ground([("state", [Number(0)])])

    def start(self, true: frozenset[str], candidates: frozenset[str]) -> list[int]:
        """Assumptions that make these fluents true at step 0, of which candidates are left open.

        All others are false. Raises ValueError for what is no inertial fluent.
        """
        unknown = true.union(candidates) - self._initial.keys()
        if unknown:
            raise ValueError(f"no inertial fluent: {min(unknown)}")
        assumed = {f: n if f in true else -n for f, n in self._initial.items()}
        for fluent in candidates:
            del assumed[fluent]
        return list(assumed.values())

    def plan(
        self, start: Sequence[int], goal: Sequence[str], length: int
    ) -> tuple[str, ...] | None:
        """The first plan of exactly this length, or None. Raises TimeLimitError."""
        self.grow(length)
        assumptions = self._assumptions(start, goal, length)
        if assumptions is None:
            return None
        with solving(self.control, assumptions) as model:
            return None if model is None else _read(model)

    def grow(self, length: int) -> None:
        """Grounds what is missing of so many steps."""
        with standing_still():
            for step in range(self._steps + 1, length + 1):
                self.control.ground([("step", [Number(step)]), ("state", [Number(step)])])
                active = self.control.symbolic_atoms[Function("active", [Number(step - 1)])]
                assert active is not None, "every step can be used"
                self._active.append(active.literal)
                self._steps = step

    def _assumptions(
        self, start: Sequence[int], goal: Sequence[str], length: int
    ) -> list[int] | None:
        used = [number if step < length else -number for step, number in enumerate(self._active)]
        wanted = []
        for literal in goal:
            number = self._holds(atom(literal), length)
            if number is not None:
                wanted.append(number if is_positive(literal) else -number)
            elif is_positive(literal):
                return None
        return [*start, *used, *wanted]

    def _holds(self, fluent: str, step: int) -> int | None:
        key = (fluent, step)
        if key not in self._literals:
            found = self.control.symbolic_atoms[Function("holds", [symbol(fluent), Number(step)])]
            self._literals[key] = None if found is None else found.literal
        return self._literals[key]

    def _inertial(self) -> Mapping[str, int]:
        """The solver's literals of the inertial fluents at step 0."""
        return {
            str(found.symbol.arguments[0]): found.literal
            for found in self.control.symbolic_atoms.by_signature("holds", 2)
        }


def _read(model: clingo.Model) -> tuple[str, ...]:
    steps = sorted((s.arguments[1].number, str(s.arguments[0])) for s in model.symbols(shown=True))
    return tuple(action for _, action in steps)
