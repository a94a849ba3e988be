"""Paths of a refined description, found by clingo in its translated program."""

from __future__ import annotations

import random
from collections.abc import Iterable
from functools import cache

import clingo

from asp.language import Action, Fluent, Literal, Problems, signature_of, syntax
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

    def find(self, start: Iterable[Literal], end: Iterable[Literal]) -> list[Action] | None:
        """The actions of one path; the states are told by literals, as far as constants are known.

        None: there is no path.
        """
        assumed = [*self._told(start, 0), *self._told(end, self.steps)]
        with solving(self._control, [self._literal(told) for told in assumed]) as model:
            if model is None:
                return None
            shown = [s for s in model.symbols(shown=True) if s.positive]
        done = [(s.arguments[1].number, Action.parse(str(s.arguments[0]))) for s in shown]
        return [action for _, action in sorted(done)]

    def _literal(self, told: str) -> int:
        """The program's literal of an atom; one that no rule derives is false."""
        if told not in self._literals:
            atom = self._control.symbolic_atoms[clingo.parse_term(told)]
            self._literals[told] = -_TRUE if atom is None else atom.literal
        return self._literals[told]

    def _told(self, literals: Iterable[Literal], step: int) -> list[str]:
        return [
            f"{'' if literal.is_positive else '-'}holds({literal.atom},{step})"
            for literal in literals
            if self.constants.issuperset(literal.arguments)
        ]


def literals_of(refinement: Refinement, state: frozenset[Fluent]) -> list[Literal]:
    """The coarse state, complete."""
    return [f if f in state else f.complement for f in refinement.description.fluents]


def drawn_refinement(
    refinement: Refinement, state: frozenset[Fluent], rng: random.Random
) -> list[Literal]:
    """A refinement of a state of a level: a cell for each thing, a part of what is held."""
    rooms = dict(f.arguments for f in state if f.name == "loc")
    held = {o: r for r, o in (f.arguments for f in state if f.name == "in_hand")}
    cells = {thing: rng.choice(refinement.components[room]) for thing, room in rooms.items()}
    cells |= {thing: cells[robot] for thing, robot in held.items()}
    grasped = {(robot, rng.choice(refinement.components[o])) for o, robot in held.items()}
    parts = {part: cell for thing, cell in cells.items() for part in refinement.components[thing]}
    robots = refinement.coarse_signature.sorts["robot"]
    return [
        *(Literal.of("fine_loc", place) for place in parts.items()),
        *(
            Literal.of("fine_in_hand", (robot, part), (robot, part) in grasped)
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
    refinement: Refinement, literals: list[Literal], rng: random.Random
) -> frozenset[Fluent]:
    """The true inertial atoms of a refinement of a coarse state, drawn literal by literal."""
    told = list(literals)
    for literal in (each for each in literals if each.is_positive):
        groups = list(refinement.counterpart(literal))
        rng.shuffle(groups)
        told += next(g for g in groups if _model(refinement, [*told, *g]) is not None)
    found = _model(refinement, told)
    assert found is not None
    return found


def _model(refinement: Refinement, literals: list[Literal]) -> frozenset[Fluent] | None:
    told = [
        (clingo.parse_term(f"{'' if literal.is_positive else '-'}holds({literal.atom},0)"), True)
        for literal in literals
    ]
    model = first_model(_states(refinement), told)
    return None if model is None else frozenset(Literal.parse(str(each)) for each in model)
