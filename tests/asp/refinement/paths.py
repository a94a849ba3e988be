"""Paths of a refined description, found by clingo in its translated program."""

from __future__ import annotations

import random
from collections.abc import Iterable
from functools import cache

import clingo

from asp.language import Problems, arguments, atom, complement, is_positive, signature_of, syntax
from asp.refinement import Refinement
from asp.solving import first_model, ground, solving
from asp.translation import translate_source

_TRUE = 1  # the literal that every program of clingo has for what is true
_ONE_ACTION = """
{{ occurs(A,I) : {kind}_action(A) }} 1 :- step(I), I < n.
#show.
#show occurs/2.
"""


class Paths:
    """Paths of at most so many steps between states of a description.

    At each step there is at most one action, all of one kind: agent or exogenous.
    """

    def __init__(self, source: syntax.Source, kind: syntax.ActionKind, steps: int) -> None:
        signature = signature_of(source, Problems(source.file))
        program = translate_source(source, signature).replace("#const n = 1.", "")
        self.steps = steps
        self.constants = signature.constants
        self._literals: dict[str, int] = {}
        self._control = ground([program, _ONE_ACTION.format(kind=kind)], {"n": steps}, [])

    def find(self, start: Iterable[str], end: Iterable[str]) -> list[str] | None:
        """The actions of one path; the states are told by literals, as far as constants are known.

        None: there is no path.
        """
        assumed = [*self._told(start, 0), *self._told(end, self.steps)]
        with solving(self._control, [self._literal(told) for told in assumed]) as model:
            if model is None:
                return None
            shown = [s for s in model.symbols(shown=True) if s.positive]
        done = [(s.arguments[1].number, str(s.arguments[0])) for s in shown]
        return [action for _, action in sorted(done)]

    def _literal(self, told: str) -> int:
        """The program's literal of an atom; one that no rule derives is false."""
        if told not in self._literals:
            atom = self._control.symbolic_atoms[clingo.parse_term(told)]
            self._literals[told] = -_TRUE if atom is None else atom.literal
        return self._literals[told]

    def _told(self, literals: Iterable[str], step: int) -> list[str]:
        return [
            f"{'' if is_positive(literal) else '-'}holds({atom(literal)},{step})"
            for literal in literals
            if self.constants.issuperset(arguments(literal))
        ]


def literals_of(refinement: Refinement, state: frozenset[str]) -> list[str]:
    """The coarse state, complete."""
    return [f if f in state else complement(f) for f in refinement.description.fluents]


def drawn_refinement(
    refinement: Refinement, state: frozenset[str], rng: random.Random
) -> list[str]:
    """A refinement of a state of a level: a cell for each thing, a part of what is held."""
    rooms = dict(arguments(f) for f in state if f.startswith("loc("))
    held = {o: r for r, o in (arguments(f) for f in state if f.startswith("in_hand("))}
    cells = {thing: rng.choice(refinement.components[room]) for thing, room in rooms.items()}
    cells |= {thing: cells[robot] for thing, robot in held.items()}
    grasped = {(robot, rng.choice(refinement.components[o])) for o, robot in held.items()}
    parts = {part: cell for thing, cell in cells.items() for part in refinement.components[thing]}
    robots = refinement.coarse_signature.sorts["robot"]
    return [
        *(f"fine_loc({part},{cell})" for part, cell in parts.items()),
        *(
            f"{'' if (robot, part) in grasped else '-'}fine_in_hand({robot},{part})"
            for robot in robots
            for part in refinement.weak_signature.sorts["part"]
        ),
    ]


@cache
def _states(refinement: Refinement) -> clingo.Control:
    source, signature = refinement.weak, refinement.weak_signature
    program = translate_source(source, signature).replace("#const n = 1.", "")
    return ground([program, "#show. #show F : holds(F,0), inertial(F)."], {"n": 0}, [])


def some_refinement(
    refinement: Refinement, literals: list[str], rng: random.Random
) -> frozenset[str]:
    """The true inertial atoms of a refinement of a coarse state, drawn literal by literal."""
    told = list(literals)
    for literal in filter(is_positive, literals):
        groups = list(refinement.counterpart(literal))
        rng.shuffle(groups)
        told += next(g for g in groups if _model(refinement, [*told, *g]) is not None)
    found = _model(refinement, told)
    assert found is not None
    return found


def _model(refinement: Refinement, literals: list[str]) -> frozenset[str] | None:
    told = [
        (clingo.parse_term(f"{'' if is_positive(literal) else '-'}holds({atom(literal)},0)"), True)
        for literal in literals
    ]
    model = first_model(_states(refinement), told)
    return None if model is None else frozenset(map(str, model))
