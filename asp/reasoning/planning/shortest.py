"""Shortest plans of one description: a search where it can be searched, else clingo.

Where states can be searched (`asp.reasoning.planning.large.search`) the search gives the plan. Else
clingo finds it, in a program for each length that is grounded once.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from itertools import chain, product, repeat

import clingo
from clingo import Symbol

from asp.language import Action, Description, Literal
from asp.reasoning.planning.large.search import Search, StateSpace
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

MOST_LEVELS = 32_767
"""As many levels of decisions as clasp tells apart: those beyond come in any order."""

_LEAST_HORIZON = 8


@dataclass
class _Question:
    """A problem that is not answered yet; no plan is shorter than `length`."""

    asked: tuple[State, tuple[Literal, ...]]
    search: Search | None
    length: int = 1


class ShortestPlans:
    """Plans of a description, in the order of declaration of its actions."""

    def __init__(
        self,
        description: Description,
        program: str,
        space: StateSpace | None,
    ) -> None:
        """`program` is the description's translation, `space` what it is searched in, if it is."""
        self._fluents = description.fluents
        self._actions = description.agent_actions
        self._program = program
        self._space = space
        self._planning: Recent[int, Session] = Recent(MOST_LENGTHS)
        self._following: Recent[int, Session] = Recent(MOST_LENGTHS)
        self._open: _Question | None = None

    def shortest(
        self, state: State, goal: tuple[Literal, ...], limit: int
    ) -> tuple[Action, ...] | None:
        """The first of the shortest plans of at most `limit` actions, or None.

        Raises LimitError; asked again, it goes on where it was.
        """
        question, self._open = self._open, None
        if question is None or question.asked != (state, goal):
            question = _Question((state, goal), self._search(state, goal))
        try:
            return self._answer(question, limit)
        except LimitError:
            self._open = question
            raise

    def succeeds(self, state: State, goal: tuple[Literal, ...], plan: tuple[Action, ...]) -> bool:
        """Whether the goal holds after some of the plan's actions, all possible until then (36)."""
        if self._space is not None:
            return self._space.succeeds(state, goal, plan)
        # Few horizons serve all lengths.
        horizon = 1 << (max(len(plan), _LEAST_HORIZON) - 1).bit_length()
        session = self._following.get(horizon, lambda: self._session("follow", horizon))
        follows = (fact("follows", action, step) for step, action in enumerate(plan))
        session.switch_on(*goal_externals(goal), *follows)
        start = session.assume_state(state, 0)
        return start is not None and is_satisfiable(session.control, start)

    def reachable(self, state: State, goal: tuple[Literal, ...]) -> bool | None:
        """Whether some state that can be reached satisfies the goal; None where nothing is said.

        Raises LimitError.
        """
        search = self._search(state, goal)
        return (
            None if search is None else search.distance(None, current().take_expansions) is not None
        )

    def _search(self, state: State, goal: tuple[Literal, ...]) -> Search | None:
        return None if self._space is None else self._space.search(state, goal)

    def _answer(self, question: _Question, limit: int) -> tuple[Action, ...] | None:
        if question.search is not None:
            spend = current().take_expansions
            least = question.search.distance(limit, spend)
            return None if least is None else question.search.first_plan(spend)
        while question.length <= limit:
            plan = self._of_length(question)
            if plan is not None:
                return plan
            question.length += 1
        return None

    def _of_length(self, question: _Question) -> tuple[Action, ...] | None:
        """The first plan of the question's length in the order of declaration, or None."""
        (state, goal), length = question.asked, question.length
        session = self._planning.get(length, lambda: self._session("plan", length))
        session.switch_on(*goal_externals(goal))
        start = session.assume_state(state, 0)
        if start is None:
            return None
        with solving(session.control, start) as model:
            return None if model is None else self._read(session, model, length)

    def _session(self, part: str, steps: int) -> Session:
        facts = _candidates(self._actions, steps)
        return Session(self._program, "incremental_planning", self._fluents, facts, [part], n=steps)

    def _read(self, session: Session, model: clingo.Model, length: int) -> tuple[Action, ...]:
        return tuple(
            next(
                action
                for action in self._actions
                if (literal := session.literal("occurs", action, step)) is not None
                and model.is_true(literal)
            )
            for step in range(length)
        )


def _candidates(actions: Iterable[Action], steps: int) -> Iterator[Symbol]:
    """candidate(A,I,L): the earlier in this order, the higher the level, while there are any."""
    levels = chain(range(MOST_LEVELS, 0, -1), repeat(0))
    for (step, action), level in zip(product(range(steps), actions), levels, strict=False):
        yield fact("candidate", action, step, level)
