"""Shortest plans, looked for in the part of the domain that matters to the goal.

What only large problems need is switched here.
"""

from __future__ import annotations

from collections.abc import Iterable
from pathlib import Path

from asp.language import (
    Action,
    Description,
    Literal,
    analyse,
    ground_description,
    narrowed,
    restrict,
    without_exogenous,
)
from asp.reasoning.planning.large.operators import Encoding
from asp.reasoning.planning.large.outcomes import NotEncodableError
from asp.reasoning.planning.large.search import StateSpace
from asp.reasoning.planning.shortest import ShortestPlans
from asp.reasoning.relevance import Relevance, interchangeable
from asp.solving import Recent, State, preparation
from asp.translation import translate_source

STATE_SET_SEARCH = True
"""Whether states are searched: without, Table 1 takes 1.8 times as long, 3 of 16 books 95 times."""

MOST_STATES = 2**29
"""The largest number of states that are searched: up to 600 MB of memory were measured."""

MOST_PARTS = 16
"""Of how many parts of a domain planners are kept: those that were used last."""


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
        self._parts: Recent[frozenset[str], ShortestPlans] = Recent(MOST_PARTS)

    def shortest(
        self, state: State, goal: tuple[Literal, ...], limit: int
    ) -> tuple[Action, ...] | None:
        """The first of the shortest plans of at most `limit` actions, or None.

        Earlier actions count before later ones, at one step the action declared first. Raises
        LimitError; asked the same again, it goes on where it was.
        """
        view = _View(self._relevance, self._classes, state, goal)
        plan = self._part(view.dropped).shortest(view.state, view.goal, limit)
        return None if plan is None else view.back(plan)

    def succeeds(self, state: State, goal: tuple[Literal, ...], plan: tuple[Action, ...]) -> bool:
        """Whether the goal holds after some of the plan's actions, all possible until then (36)."""
        view = _View(self._relevance, self._classes, state, (*goal, *plan))
        return self._part(view.dropped).succeeds(view.state, view.seen(goal), view.seen(plan))

    def reachable(self, state: State, goal: tuple[Literal, ...]) -> bool | None:
        """Whether a plan of any length succeeds; None where there is too much to look at.

        Raises LimitError.
        """
        view = _View(self._relevance, self._classes, state, goal)
        return self._part(view.dropped).reachable(view.state, view.goal)

    def _part(self, dropped: frozenset[str]) -> ShortestPlans:
        return self._parts.get(dropped, lambda: self._make_part(dropped))

    def _make_part(self, dropped: frozenset[str]) -> ShortestPlans:
        with preparation():
            source = restrict(self._source, dropped)
            signature = narrowed(self._signature, dropped)
            description = ground_description(source, signature, self._name)
            return ShortestPlans(
                description,
                translate_source(source, signature),
                _state_space(description) if STATE_SET_SEARCH else None,
            )


def _state_space(description: Description) -> StateSpace | None:
    try:
        space = StateSpace(Encoding(description))
    except NotEncodableError:
        return None
    return space if space.size <= MOST_STATES else None


class _View:
    """A planning problem without the constants that it can do without, in canonical names."""

    def __init__(
        self,
        relevance: Relevance,
        classes: Iterable[tuple[str, ...]],
        state: State,
        goal: tuple[Literal, ...],
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
        return tuple(
            literal.renamed(self._names)
            for literal in literals
            if self._spare.isdisjoint(literal.arguments)
        )

    def back(self, plan: tuple[Action, ...]) -> tuple[Literal, ...]:
        """The plan in the names of the problem."""
        back = {new: old for old, new in self._names.items()}
        return tuple(action.renamed(back) for action in plan)
