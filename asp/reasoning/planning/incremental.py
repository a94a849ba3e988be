"""Shortest plans, looked for in the part of the domain that matters to the goal.

What only large problems need is switched here.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from itertools import chain, product, repeat
from pathlib import Path

from clingo import Symbol

from asp.language import (
    Action,
    Description,
    Literal,
    Signature,
    analyse,
    ground_description,
    narrowed,
    restrict,
    syntax,
    without_exogenous,
)
from asp.reasoning.knowledge import Goal
from asp.reasoning.planning.large.operators import Encoding
from asp.reasoning.planning.large.outcomes import NotEncodableError
from asp.reasoning.planning.large.search import Search, StateSpace
from asp.reasoning.planning.reference import Plan
from asp.reasoning.relevance import Relevance, interchangeable
from asp.solving import (
    LimitError,
    Recent,
    Session,
    State,
    fact,
    goal_externals,
    is_satisfiable,
    preparation,
    solving,
)
from asp.translation import translate_source

STATE_SET_SEARCH = True
"""Whether states are searched: without, Table 1 takes 1.8 times as long, 3 of 16 books 95 times."""

MOST_STATES = 2**29
"""The largest number of states that are searched: up to 600 MB of memory were measured."""

MOST_PARTS = 16
"""Of how many parts of a domain planners are kept: those that were used last."""

MOST_LENGTHS = 40
"""Of how many lengths of plans sessions are kept: those that were used last.

Where no search gives the length they are asked one after the other, from 1 to that of the plan:
were fewer kept than a plan has actions, each decision would ground all of them again.
"""

MOST_LEVELS = 32_767
"""As many levels of decisions as clasp tells apart: those beyond come in any order."""

_LEAST_HORIZON = 8


class IncrementalPlanner:
    """Shortest plans of a domain from complete states; each part of it is prepared once.

    Constants that a goal can do without are left out (`asp.reasoning.relevance`); those that are
    left are renamed to the first of their class, so that problems that differ in names alone share
    what is prepared. Both leave the first shortest plan what it is.
    """

    def __init__(self, text: str, file: str) -> None:
        """`text` is an AL_d text, `file` its name in errors. Raises SourceError."""
        source, self._signature = analyse(text, file)
        self._source = without_exogenous(source, self._signature)
        self._name = Path(file).stem
        self._relevance = Relevance(self._source, self._signature)
        self._classes = interchangeable(source, self._signature)
        self._parts: Recent[frozenset[str], _Part] = Recent(MOST_PARTS)

    def shortest(self, state: State, goal: Goal, limit: int) -> Plan | None:
        """The first of the shortest plans of at most `limit` actions, or None.

        Earlier actions count before later ones, at one step the action declared first. Raises
        LimitError; asked the same again, it goes on where it was.
        """
        view = _View(self._relevance, self._classes, state, goal)
        plan = self._part(view.dropped).shortest(view.state, view.goal, limit)
        return None if plan is None else view.back(plan)

    def succeeds(self, state: State, goal: Goal, plan: Plan) -> bool:
        """Whether the goal holds after some of the plan's actions, all possible until then (36)."""
        view = _View(self._relevance, self._classes, state, (*goal, *plan))
        return self._part(view.dropped).succeeds(view.state, view.seen(goal), view.seen(plan))

    def reachable(self, state: State, goal: Goal) -> bool | None:
        """Whether a plan of any length succeeds; None: too much to look at. Raises LimitError."""
        view = _View(self._relevance, self._classes, state, goal)
        return self._part(view.dropped).reachable(view.state, view.goal)

    def _part(self, dropped: frozenset[str]) -> _Part:
        def make() -> _Part:
            with preparation():
                source = restrict(self._source, dropped)
                return _Part(source, narrowed(self._signature, dropped), self._name)

        return self._parts.get(dropped, make)


class _View:
    """A planning problem without the constants that it can do without, in canonical names."""

    def __init__(
        self, relevance: Relevance, classes: Iterable[tuple[str, ...]], state: State, goal: Goal
    ) -> None:
        self._spare = relevance.spare(state, goal)
        self._names: dict[str, str] = {}
        dropped = set(self._spare)
        for members in classes:
            if relevance.independent.issuperset(members):
                kept = [constant for constant in members if constant not in self._spare]
                self._names.update(zip(kept, members, strict=False))
                dropped.difference_update(members)
                dropped.update(members[len(kept) :])
        self.dropped = frozenset(dropped)
        self.state = frozenset(self.seen(state))
        self.goal = self.seen(goal)

    def seen(self, literals: Iterable[Literal]) -> tuple[Literal, ...]:
        """Those of the literals or actions that the problem is left with, in its names."""
        left = (each for each in literals if self._spare.isdisjoint(each.arguments))
        return tuple(each.renamed(self._names) for each in left)

    def back(self, plan: Plan) -> Plan:
        """The plan in the names of the problem."""
        back = {new: old for old, new in self._names.items()}
        return tuple(action.renamed(back) for action in plan)


@dataclass
class _Question:
    """A problem that is not answered yet; no plan is shorter than `length`."""

    asked: tuple[State, Goal]
    search: Search | None
    length: int = 1


class _Part:
    """Shortest plans of a part of a domain: by a search where states are searched, else by clingo.

    Clingo finds them in a program for each length that is grounded once.
    """

    def __init__(self, source: syntax.Source, signature: Signature, name: str) -> None:
        description = ground_description(source, signature, name)
        self._fluents = description.fluents
        self._actions = description.agent_actions
        self._program = translate_source(source, signature)
        self._space = _state_space(description) if STATE_SET_SEARCH else None
        self._planning: Recent[int, Session] = Recent(MOST_LENGTHS)
        self._following: Recent[int, Session] = Recent(MOST_LENGTHS)
        self._open: _Question | None = None

    def shortest(self, state: State, goal: Goal, limit: int) -> Plan | None:
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

    def succeeds(self, state: State, goal: Goal, plan: Plan) -> bool:
        """Whether the goal holds after some of the plan's actions, all possible until then (36)."""
        found = None if self._space is None else self._space.succeeds(state, goal, plan)
        if found is not None:
            return found
        # Few horizons serve all lengths.
        horizon = 1 << (max(len(plan), _LEAST_HORIZON) - 1).bit_length()
        session = self._following.get(horizon, lambda: self._session("follow", horizon))
        follows = (fact("follows", action, step) for step, action in enumerate(plan))
        session.switch_on(*goal_externals(goal), *follows)
        start = session.assume_state(state, 0)
        return start is not None and is_satisfiable(session.control, start)

    def reachable(self, state: State, goal: Goal) -> bool | None:
        """Whether a plan of any length succeeds; None: too much to look at. Raises LimitError."""
        search = self._search(state, goal)
        return None if search is None else search.distance(None) is not None

    def _search(self, state: State, goal: Goal) -> Search | None:
        return None if self._space is None else self._space.search(state, goal)

    def _answer(self, question: _Question, limit: int) -> Plan | None:
        if question.search is not None:
            least = question.search.distance(limit)
            return None if least is None else question.search.first_plan()
        while question.length <= limit:
            if (plan := self._of_length(question)) is not None:
                return plan
            question.length += 1
        return None

    def _of_length(self, question: _Question) -> Plan | None:
        """The first plan of the question's length in the order of declaration, or None."""
        (state, goal), length = question.asked, question.length
        session = self._planning.get(length, lambda: self._session("plan", length))
        session.switch_on(*goal_externals(goal))
        start = session.assume_state(state, 0)
        if start is None:
            return None
        with solving(session.control, start) as model:
            if model is None:
                return None
            return tuple(
                action
                for step, action in product(range(length), self._actions)
                if session.is_true(model, "occurs", action, step)
            )

    def _session(self, part: str, steps: int) -> Session:
        facts = _candidates(self._actions, steps)
        return Session(self._program, "incremental_planning", self._fluents, facts, [part], n=steps)


def _state_space(description: Description) -> StateSpace | None:
    try:
        space = StateSpace(Encoding(description))
    except NotEncodableError:
        return None
    return space if space.size <= MOST_STATES else None


def _candidates(actions: Iterable[Action], steps: int) -> Iterator[Symbol]:
    """candidate(A,I,L): the earlier in this order, the higher the level, while there are any."""
    levels = chain(range(MOST_LEVELS, 0, -1), repeat(0))
    for (step, action), level in zip(product(range(steps), actions), levels, strict=False):
        yield fact("candidate", action, step, level)
