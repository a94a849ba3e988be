"""Plans at the fine resolution as the theory says: the literal translation, solved from scratch."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from enum import Enum
from typing import Protocol

from clingo import Symbol

from asp.language import (
    Action,
    Fluent,
    Function,
    Literal,
    Literals,
    Signature,
    functions,
    narrowed,
    restrict,
    subject,
    syntax,
)
from asp.solving import fact, first_model, ground, literal_of, select, theory
from asp.translation import translate_source

FinePlan = tuple[Action, ...]
"""Concrete actions, in order."""

_TEST, _OBSERVED = "test_", "observed_"


class NoPlan(Enum):
    """Why there is no plan: none of any length, or none of at most so many actions."""

    OUT_OF_REACH = "out of reach"
    BEYOND_LIMIT = "beyond the limit"


@dataclass(frozen=True)
class FineStart:
    """What is taken for certain of the present state at the fine resolution, and what is not.

    `true` are inertial fluents, `candidates` groups of them of each of which exactly one holds; all
    other inertial fluents are false. A group without members is a contradiction.
    """

    true: frozenset[Fluent]
    candidates: tuple[tuple[Fluent, ...], ...] = ()

    def within(self, constants: frozenset[str]) -> FineStart:
        """What it says of these constants only."""
        true = (f for f in self.true if constants.issuperset(f.arguments))
        groups = (_within(group, constants) for group in self.candidates)
        return FineStart(frozenset(true), tuple(group for group in groups if group))


class FinePlanner(Protocol):
    """Shortest plans in a refined description, or in parts of it."""

    def plan(
        self, start: FineStart, goal: Literals, limit: int, constants: frozenset[str] | None = None
    ) -> FinePlan | NoPlan:
        """The first of the shortest plans of at most `limit` actions.

        Of candidates those are assumed that make it short. `constants` are those of the part of
        the description that is planned in (None: the whole). A goal is out of reach if no plan of
        any length achieves it, as far as the planner can tell.
        Raises LimitError, and ValueError for candidates that are not values of one total function.
        """


class LiteralProblem:
    """A planning problem in the literal translation of the strong refinement.

    Every concrete action is followed by a test of its outcome, and what is not certain is found by
    a test before anything is done with it. In the weak refinement, which has no tests, plans have
    none either.
    """

    def __init__(
        self, source: syntax.Source, signature: Signature, start: FineStart, goal: Iterable[Literal]
    ) -> None:
        self._texts = (
            translate_source(source, signature),
            "\n".join([*_tests(signature), *_changes(source)]),
            theory("fine_planning"),
        )
        actions = [a for a in signature.atoms("agent") if not a.name.startswith(_TEST)]
        self._facts = [fact("ranks", len(actions))]
        self._facts += (fact("rank", action, number) for number, action in enumerate(actions))
        self._facts += (fact("certain", fluent) for fluent in sorted(start.true))
        groups = enumerate(start.candidates)
        self._facts += (fact("candidate", n, fluent) for n, group in groups for fluent in group)
        if any(symbol.startswith(_TEST) for symbol in signature.symbols):
            self._facts += _dealing(start, actions, functions(source, signature))
        self._facts += (fact("wanted" if g.is_positive else "unwanted", g.atom) for g in goal)

    def plan(self, length: int) -> FinePlan | None:
        """The first plan of exactly so many actions and tests, or None. Raises LimitError."""
        model = first_model(ground(self._texts, {"n": length}, self._facts))
        if model is None:
            return None
        steps = sorted(select(model, "occurs", 2), key=lambda pair: pair[1])
        return tuple(literal_of(action) for action, _ in steps)


class ReferenceFinePlanner:
    """A `FinePlanner` for any laws: their literal translation, solved from scratch."""

    def __init__(self, source: syntax.Source, signature: Signature) -> None:
        """`source` is a refined description: with the theory of observation plans have tests."""
        self._source = source
        self._signature = signature

    def plan(
        self, start: FineStart, goal: Literals, limit: int, constants: frozenset[str] | None = None
    ) -> FinePlan | NoPlan:
        """The first of the shortest plans of at most `limit` actions and tests."""
        if not all(start.candidates):
            return NoPlan.OUT_OF_REACH
        kept = self._signature.constants if constants is None else constants
        dropped = self._signature.constants - kept
        source, signature = restrict(self._source, dropped), narrowed(self._signature, dropped)
        problem = LiteralProblem(source, signature, start.within(kept), goal)
        for length in range(limit + 1):
            plan = problem.plan(length)
            if plan is not None:
                return plan
        return NoPlan.BEYOND_LIMIT


def _within(group: tuple[Literal, ...], constants: frozenset[str]) -> tuple[Literal, ...]:
    first, last = group[0].arguments, group[-1].arguments
    # What two candidates share, all do.
    if not constants.issuperset(a for a, b in zip(first, last, strict=True) if a == b):
        return ()
    return tuple(f for f in group if constants.issuperset(f.arguments))


def _tests(signature: Signature) -> Iterator[str]:
    """tests_fluent(A,F,O): by the names that refinement gives to tests and to what they tell."""
    for symbol in signature.symbols.values():
        if not symbol.name.startswith(_TEST):
            continue
        tested = signature.symbols[symbol.name.removeprefix(_TEST)]
        outcomes = signature.sorts[signature.symbols[_OBSERVED + tested.name].sorts[-1].name]
        given = [f"X{number}" for number, _ in enumerate(symbol.sorts)]
        # The robot that tests comes first; where the fluent is about this robot, only once.
        about = given[len(given) - len(tested.sorts) :]
        test, fluent = Literal.of(symbol.name, given), Literal.of(tested.name, about)
        found = Literal.of(_OBSERVED + tested.name, [*given, outcomes[0]])
        yield f"tests_fluent({test},{fluent},{found}) :- agent_action({test})."


def _changes(source: syntax.Source) -> Iterator[str]:
    for law in source.each(syntax.CausalLaw):
        action, fluent = law.action, law.head.atom
        yield f"changes({action},{fluent}) :- agent_action({action}), inertial({fluent})."


def _dealing(
    start: FineStart, actions: Iterable[Action], known: Mapping[str, Function]
) -> Iterator[Symbol]:
    """deals_with(A,G): the actions that name what a group of candidates is about."""
    about = [frozenset(function_of(group, known)[1:]) for group in start.candidates]
    for action in actions:
        named = frozenset(action.arguments)
        yield from (fact("deals_with", action, n) for n, some in enumerate(about) if some <= named)


def function_of(group: Sequence[Literal], known: Mapping[str, Function]) -> tuple[str, ...]:
    """The function, with its other arguments, that candidates are values of.

    Raises ValueError for a group that is not made of values of one total function.
    """
    first, *others = {subject(fluent, known) for fluent in group}
    if others or first is None:
        raise ValueError(f"not values of one function that always has one: {', '.join(group)}")
    return first
