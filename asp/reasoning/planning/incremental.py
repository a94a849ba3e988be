"""Shortest plans, looked for in the part of the domain that matters to the goal."""

from __future__ import annotations

from collections.abc import Iterable
from pathlib import Path

from asp.language import (
    analyse,
    arguments,
    ground_description,
    narrowed,
    parse_description,
    renamed,
    restrict,
    without_exogenous,
)
from asp.reasoning.planning.horizons import Planner
from asp.reasoning.planning.relevance import Independence, symmetric_pairs
from asp.solving import Recent, State, preparation
from asp.translation import translate_source

MOST_PARTS = 16
"""Of how many parts of a domain planners are kept: those that were used last."""


class Plans:
    """Shortest plans of a domain, and what becomes of given ones.

    Constants that a goal can do without are left out (`Independence`); those that are left are
    renamed to the first of their class, so that problems that differ in names alone share their
    controls. Both leave the first shortest plan what it is.
    """

    def __init__(self, text: str, file: str) -> None:
        """`text` is an AL_d text, `file` its name in errors. Raises SourceError."""
        self._source, self._signature = analyse(text, file)
        self._name = Path(file).stem
        description = parse_description(text, file)
        self._independence = Independence(description, self._source, self._signature)
        self._planners: Recent[frozenset[str], Planner] = Recent(MOST_PARTS)

    def shortest(self, state: State, goal: tuple[str, ...], limit: int) -> tuple[str, ...] | None:
        """The first of the shortest plans of at most `limit` actions, or None.

        Raises LimitError; asked the same again, it goes on where it was.
        """
        view = _View(self._independence, state, goal)
        planner = self._planner(view.dropped)
        pairs = symmetric_pairs(planner.classes, view.state, view.goal)
        plan = planner.shortest(view.state, view.goal, limit, pairs)
        return None if plan is None else view.back(plan)

    def succeeds(self, state: State, goal: tuple[str, ...], plan: tuple[str, ...]) -> bool:
        """Whether the goal holds after some of the plan's actions, all possible until then (36)."""
        view = _View(self._independence, state, (*goal, *plan))
        planner = self._planner(view.dropped)
        return planner.succeeds(view.state, view.seen(goal), view.seen(plan))

    def reachable(self, state: State, goal: tuple[str, ...]) -> bool | None:
        """Whether a plan of any length succeeds; None where there is too much to look at.

        Raises LimitError.
        """
        view = _View(self._independence, state, goal)
        return self._planner(view.dropped).reachable(view.state, view.goal)

    def _planner(self, dropped: frozenset[str]) -> Planner:
        return self._planners.get(dropped, lambda: self._make_planner(dropped))

    def _make_planner(self, dropped: frozenset[str]) -> Planner:
        with preparation():
            source = restrict(without_exogenous(self._source, self._signature), dropped)
            signature = narrowed(self._signature, dropped)
            return Planner(
                ground_description(source, signature, self._name),
                translate_source(source, signature),
                [
                    [constant for constant in members if constant not in dropped]
                    for members in self._independence.classes
                ],
            )


class _View:
    """A planning problem without the constants that it can do without, in canonical names."""

    def __init__(self, independence: Independence, state: State, goal: tuple[str, ...]) -> None:
        spare = independence.droppable(state, goal)
        self._names: dict[str, str] = {}
        dropped: list[str] = []
        for members in independence.classes:
            kept = [constant for constant in members if constant not in spare]
            exchangeable = independence.candidates.issuperset(members)
            names = members if exchangeable else kept
            self._names.update(zip(kept, names, strict=False))
            dropped += members[len(kept) :] if exchangeable else (c for c in members if c in spare)
        self.dropped = frozenset(dropped)
        self._spare = spare
        self.state = frozenset(self.seen(state))
        self.goal = self.seen(goal)

    def seen(self, literals: Iterable[str]) -> tuple[str, ...]:
        """Those of the literals or actions that the problem is left with, in its names."""
        return tuple(
            renamed(literal, self._names) for literal in literals if not self._drops(literal)
        )

    def back(self, plan: tuple[str, ...]) -> tuple[str, ...]:
        """The plan in the names of the problem."""
        self._names = {new: old for old, new in self._names.items()}
        return tuple(renamed(action, self._names) for action in plan)

    def _drops(self, literal: str) -> bool:
        return not self._spare.isdisjoint(arguments(literal))
