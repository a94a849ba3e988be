"""Shortest plans of one description, and what becomes of given ones.

A search gives the length of a shortest plan and narrows down its steps where the description can be
searched (`asp.reasoning.planning.large.search`); clingo finds the plan. Small problems are asked of
a control for each length, grounded once; large ones get a program of their own.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from itertools import pairwise

from clingo import Symbol

from asp.language import Description, arguments
from asp.reasoning.planning.large.operators import Encoding
from asp.reasoning.planning.large.outcomes import NotEncodableError
from asp.reasoning.planning.large.problem_program import MOST_LEVELS, NarrowPrograms
from asp.reasoning.planning.large.search import Bounds, Spaces
from asp.reasoning.planning.shared_program import SharedPrograms, horizon_of
from asp.solving import LimitError, State, current, fact

MOST_STATES = 2**24
"""The largest number of states of which sets are made: bits of memory for each set."""

_MOST_KEPT = 8_000
"""Laws, fluents and actions times steps: so many are grounded for all problems in no time."""

Pairs = tuple[tuple[str, str], ...]


@dataclass
class _Question:
    """A problem that is not answered yet; no plan is shorter than `length`."""

    asked: tuple[State, tuple[str, ...]]
    bounds: Bounds | None
    length: int = 1


class Planner:
    """Plans of a description, in the order of declaration of its actions."""

    def __init__(
        self,
        description: Description,
        program: str,
        classes: Sequence[Sequence[str]],
    ) -> None:
        """`classes` are the interchangeable constants, each class in order of declaration."""
        self.classes = tuple(tuple(members) for members in classes)
        self._description = description
        facts = tuple(_facts(description, self.classes))
        self._narrow = NarrowPrograms(description, program, facts)
        self._shared = SharedPrograms(description, program, facts)
        self._spaces = _spaces(description)
        self._size = sum(
            map(
                len,
                (
                    description.fluents,
                    description.agent_actions,
                    description.causal,
                    description.constraints,
                    description.executability,
                ),
            )
        )
        self._open: _Question | None = None

    def shortest(
        self, state: State, goal: tuple[str, ...], limit: int, symmetric: Pairs = ()
    ) -> tuple[str, ...] | None:
        """The first of the shortest plans of at most `limit` actions, or None.

        Of each symmetric pair the first constant is used first: a plan that does otherwise comes
        later in the order than the one with the two exchanged. Raises LimitError; asked again,
        it goes on where it was.
        """
        question, self._open = self._open, None
        if question is None or question.asked != (state, goal):
            question = _Question((state, goal), self._bounds(state, goal))
        try:
            return self._answer(question, limit, symmetric)
        except LimitError:
            self._open = question
            raise

    def succeeds(self, state: State, goal: tuple[str, ...], plan: tuple[str, ...]) -> bool:
        """Whether the goal holds after some of the plan's actions, all possible until then (36)."""
        programs = self._shared if self._keeps(horizon_of(plan)) else self._narrow
        return programs.succeeds(state, goal, plan)

    def reachable(self, state: State, goal: tuple[str, ...]) -> bool | None:
        """Whether some state that can be reached satisfies the goal; None where nothing is said.

        Raises LimitError.
        """
        bounds = self._bounds(state, goal)
        if bounds is None or self._spaces is None or not self._spaces.exact:
            return None
        return bounds.least(None, current().take_expansions) is not None

    def _bounds(self, state: State, goal: tuple[str, ...]) -> Bounds | None:
        return None if self._spaces is None else self._spaces.bounds(state, goal)

    def _answer(self, question: _Question, limit: int, pairs: Pairs) -> tuple[str, ...] | None:
        state, goal = question.asked
        if question.bounds is not None:
            least = question.bounds.least(limit, current().take_expansions)
            if least is None:
                return None
            question.length = max(question.length, least)
        while question.length <= limit:
            plan = self._of_length(state, goal, question, pairs)
            if plan is not None:
                return plan
            question.length += 1
        return None

    def _of_length(
        self, state: State, goal: tuple[str, ...], question: _Question, pairs: Pairs
    ) -> tuple[str, ...] | None:
        if self._keeps(question.length):
            return self._shared.first_plan(state, goal, question.length, pairs)
        steps = self._steps(question)
        return self._narrow.first_plan(state, goal, steps, pairs) if all(steps) else None

    def _keeps(self, length: int) -> bool:
        if self._spaces is not None:
            return self._size * length <= _MOST_KEPT
        return len(self._description.agent_actions) * length <= MOST_LEVELS

    def _steps(self, question: _Question) -> list[Sequence[str]]:
        """Of each step, the actions that a plan of the question's length may take there."""
        actions = self._description.agent_actions
        if question.bounds is None:
            return [actions] * question.length
        allowed = question.bounds.steps(question.length, current().take_expansions)
        return [[action for action in actions if action in some] for some in allowed]


def _spaces(description: Description) -> Spaces | None:
    try:
        return Spaces(Encoding(description), MOST_STATES)
    except NotEncodableError:
        return None


def _facts(description: Description, classes: Iterable[Sequence[str]]) -> Iterator[Symbol]:
    """names(A,C) and neighbours(C1,C2) of interchangeable constants."""
    for members in classes:
        for action in description.agent_actions:
            for constant in members:
                if constant in arguments(action):
                    yield fact("names", action, constant)
        for pair in pairwise(members):
            yield fact("neighbours", *pair)
