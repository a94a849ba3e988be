"""Shortest plans of one description: a search where it can be searched, else clingo.

Where all states can be searched (`asp.reasoning.planning.large.search`) the search gives the plan.
Else clingo finds it, in a program for each length that is grounded once; or, where a search narrows
down what each step can be, in one for the problem alone.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from itertools import pairwise

import clingo
from clingo import Symbol

from asp.language import Description, Literal
from asp.reasoning.planning.large.problem_program import ProblemPrograms, candidates
from asp.reasoning.planning.large.search import Bounds, Spaces
from asp.solving import (
    LimitError,
    Recent,
    Session,
    State,
    current,
    fact,
    goal_externals,
    is_satisfiable,
    solving,
)

MOST_LENGTHS = 40
"""Of how many lengths of plans sessions are kept: those that were used last.

Where no search gives the length they are asked one after the other, from 1 to that of the plan:
were fewer kept than a plan has actions, each decision would ground all of them again.
"""

_LEAST_HORIZON = 8

Pairs = tuple[tuple[str, str], ...]


@dataclass
class _Question:
    """A problem that is not answered yet; no plan is shorter than `length`."""

    asked: tuple[State, tuple[str, ...]]
    bounds: Bounds | None
    length: int = 1


class ShortestPlans:
    """Plans of a description, in the order of declaration of its actions."""

    def __init__(
        self,
        description: Description,
        program: str,
        classes: Iterable[Sequence[str]],
        spaces: Spaces | None,
        narrows: bool,
    ) -> None:
        """`program` is the description's translation, `spaces` what it is searched in, if it is.

        `classes` are the interchangeable constants, each class in order of declaration. With
        `narrows` problems that a search gives bounds for get programs for themselves.
        """
        self.classes = tuple(map(tuple, classes))
        self._fluents = description.fluents
        self._actions = description.agent_actions
        self._program = program
        self._facts = tuple(_facts(description, self.classes))
        self._spaces = spaces
        self._problems = (
            ProblemPrograms(description, program, self._facts) if spaces and narrows else None
        )
        self._planning: Recent[int, Session] = Recent(MOST_LENGTHS)
        self._following: Recent[int, Session] = Recent(MOST_LENGTHS)
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
        if self._spaces is not None:
            return self._spaces.succeeds(state, goal, plan)
        # Few horizons serve all lengths.
        horizon = 1 << (max(len(plan), _LEAST_HORIZON) - 1).bit_length()
        session = self._following.get(horizon, lambda: self._session("follow", horizon))
        follows = (fact("follows", action, step) for step, action in enumerate(plan))
        session.switch_on(*goal_externals(goal), *follows)
        start = session.assume_state(state, 0)
        return start is not None and is_satisfiable(session.control, start)

    def reachable(self, state: State, goal: tuple[str, ...]) -> bool | None:
        """Whether some state that can be reached satisfies the goal; None where nothing is said.

        Raises LimitError.
        """
        bounds = self._bounds(state, goal)
        if bounds is None or not bounds.exact:
            return None
        return bounds.least(None, current().take_expansions) is not None

    def _bounds(self, state: State, goal: tuple[str, ...]) -> Bounds | None:
        return None if self._spaces is None else self._spaces.bounds(state, goal)

    def _answer(self, question: _Question, limit: int, pairs: Pairs) -> tuple[str, ...] | None:
        bounds = question.bounds
        if bounds is not None:
            least = bounds.least(limit, current().take_expansions)
            if least is None:
                return None
            question.length = max(question.length, least)
            if bounds.exact:
                return bounds.first_plan(least, current().take_expansions)
        while question.length <= limit:
            plan = self._of_length(question, pairs)
            if plan is not None:
                return plan
            question.length += 1
        return None

    def _of_length(self, question: _Question, pairs: Pairs) -> tuple[str, ...] | None:
        """The first plan of the question's length in the order of declaration, or None."""
        (state, goal), length = question.asked, question.length
        if self._problems is not None and question.bounds is not None:
            allowed = question.bounds.steps(length, current().take_expansions)
            steps = [[action for action in self._actions if action in some] for some in allowed]
            return self._problems.first_plan(state, goal, steps, pairs) if all(steps) else None
        session = self._planning.get(length, lambda: self._session("plan", length))
        ordered = (fact("symmetric", *pair) for pair in pairs)
        session.switch_on(*goal_externals(goal), *ordered)
        start = session.assume_state(state, 0)
        if start is None:
            return None
        with solving(session.control, start) as model:
            return None if model is None else self._read(session, model, length)

    def _session(self, part: str, steps: int) -> Session:
        facts = (*self._facts, *candidates([self._actions] * steps))
        return Session(self._program, "incremental_planning", self._fluents, facts, [part], n=steps)

    def _read(self, session: Session, model: clingo.Model, length: int) -> tuple[str, ...]:
        return tuple(
            next(
                action
                for action in self._actions
                if (literal := session.literal("occurs", action, step)) is not None
                and model.is_true(literal)
            )
            for step in range(length)
        )


def _facts(description: Description, classes: Iterable[Sequence[str]]) -> Iterator[Symbol]:
    """names(A,C) and neighbours(C1,C2) of interchangeable constants."""
    for members in classes:
        for action in description.agent_actions:
            for constant in members:
                if constant in Literal.parse(action).arguments:
                    yield fact("names", action, constant)
        for pair in pairwise(members):
            yield fact("neighbours", *pair)
