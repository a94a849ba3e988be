"""Paths: explanations of a history that share their beginnings, each with its place in an order."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from itertools import groupby
from operator import attrgetter
from typing import TypeVar

from asp.language import Description
from asp.reasoning.diagnosis.explanations import Explanation
from asp.reasoning.diagnosis.history import Happening
from asp.reasoning.diagnosis.long_histories.arcs import Arc
from asp.reasoning.diagnosis.smallest_explanations import Interpretation
from asp.solving import State

Paths = Mapping[State, Sequence["Path"]]
"""The smallest paths to each state, in their order."""
Ways = Mapping[State, Sequence[tuple["Path", Arc]]]
"""How paths go on to each state."""

T = TypeVar("T")
_step = attrgetter("step")


@dataclass(frozen=True, slots=True, eq=False)
class Path:
    """An explanation of a history up to a step, which leads to a state.

    `last` is what it assumes of the last step, as of step 0; `before` is None at the beginning.
    `order` has its places among the paths of its step, as in `order.lp`: by what it distrusts, by
    the exceptions and the state that it begins with, by the events that it assumes.
    """

    before: Path | None
    last: Explanation
    state: State
    size: int
    exceptions: tuple[str, ...]
    order: tuple[int, int, int]

    @property
    def price(self) -> tuple[int, int]:
        """How much it assumes: its size, and then its exceptions."""
        return self.size, len(self.exceptions)

    @property
    def whole(self) -> list[Path]:
        """The paths up to each step, of which this is the last."""
        every = [self]
        while (before := every[-1].before) is not None:
            every.append(before)
        return every[::-1]

    @property
    def explanation(self) -> Explanation:
        """What it assumes of all steps."""
        unobserved, distrusted = (
            tuple(
                Happening(step, action)
                for step, path in enumerate(self.whole[1:])
                for _, action in getattr(path.last, kind)
            )
            for kind in ("unobserved", "distrusted")
        )
        return Explanation(unobserved, distrusted, self.exceptions)

    @property
    def interpretation(self) -> Interpretation:
        """The explanation with the states of all steps."""
        return Interpretation(self.explanation, [path.state for path in self.whole])


def steps_of(explanation: Explanation) -> Mapping[int, Explanation]:
    """What an explanation assumes of each step of which it assumes anything, as of step 0."""
    unobserved, distrusted = (
        {
            step: tuple(Happening(0, e.action) for e in there)
            for step, there in groupby(every, _step)
        }
        for every in (explanation.unobserved, explanation.distrusted)
    )
    steps = unobserved.keys() | distrusted.keys()
    return {i: Explanation(unobserved.get(i, ()), distrusted.get(i, ())) for i in steps}


def beginnings(found: Iterable[tuple[Explanation, State]], description: Description) -> Paths:
    """The paths of step 0: initial states with their exceptions."""
    defaults, fluents = description.defaults, description.inertial[::-1]

    def place(explanation: Explanation, state: State) -> tuple[bool, ...]:
        exceptions = (default.name in explanation.exceptions for default in defaults)
        return (*exceptions, *(fluent in state for fluent in fluents))

    in_order = sorted(found, key=lambda each: place(*each))
    return {
        state: [Path(None, explanation, state, 0, explanation.exceptions, (0, number, 0))]
        for number, (explanation, state) in enumerate(in_order)
    }


def continued(ways: Ways, most: int) -> Paths:
    """The first paths to each state, at most so many."""
    found = {state: _first(there, most) for state, there in ways.items()}
    every = [way for there in found.values() for way in there]
    by_distrust = _numbered((arc.distrusted, path.order[0]) for path, arc in every)
    by_events = _numbered((arc.assumed, path.order[2]) for path, arc in every)

    def following(path: Path, arc: Arc) -> Path:
        order = (
            by_distrust[arc.distrusted, path.order[0]],
            path.order[1],
            by_events[arc.assumed, path.order[2]],
        )
        size = path.size + arc.size
        return Path(path, arc.explanation, arc.after, size, path.exceptions, order)

    return {state: [following(*way) for way in there] for state, there in found.items()}


def _first(ways: Sequence[tuple[Path, Arc]], most: int) -> Sequence[tuple[Path, Arc]]:
    """The first in the order; of those that differ only in the initial state, the first of them."""
    if len(ways) == 1:
        return ways
    found: dict[object, tuple[Path, Arc]] = {}
    for path, arc in sorted(ways, key=_place):
        same = arc.explanation, path.order[0], path.exceptions, path.order[2]
        found.setdefault(same, (path, arc))
        if len(found) == most:
            break
    return list(found.values())


def _place(way: tuple[Path, Arc]) -> tuple[object, ...]:
    path, arc = way
    return arc.distrusted, path.order[0], path.order[1], arc.assumed, path.order[2]


def _numbered(places: Iterable[T]) -> dict[T, int]:
    """The number of each place, in their order."""
    return {place: number for number, place in enumerate(sorted(set(places)))}  # type: ignore[type-var]
