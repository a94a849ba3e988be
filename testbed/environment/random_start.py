"""Random beginnings of games: an initial state, and a goal that does not hold in it."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from itertools import product

import numpy as np

from asp.language import literals as text
from testbed.world import World


class RandomStart:
    """Draws an initial state: a value for each thing that must have one, as `initially` says.

    With probability `holding` the robot stands in a relation, such as holding, to one of the things
    that must be somewhere. What follows from that is not drawn again.
    """

    def __init__(self, world: World, robot: str, holding: float = 0.2) -> None:
        self._world = world
        self._holding = holding
        self._groups = groups = world.description.initially
        placed = {fluent for some in groups for fluent in some}
        things = {text.arguments(some[0])[0] for some in groups if text.arguments(some[0])}
        self._relations = [
            fluent
            for fluent in world.description.inertial
            if fluent not in placed and _relates(robot, fluent, things)
        ]

    def __call__(self, random: np.random.Generator) -> int:
        """The state. Everything drawn comes from the generator."""
        state = self._world.bare()
        if self._relations and random.random() < self._holding:
            state = self._with(state, [self._relations[int(random.integers(len(self._relations)))]])
        for some in self._groups:
            if not any(self._world.holds(state, fluent) for fluent in some):
                order = random.permutation(len(some))
                state = self._with(state, [some[int(number)] for number in order])
        return state

    def _with(self, state: int, options: Sequence[str]) -> int:
        """A state in which the first of the options holds that can."""
        found = (self._world.adjusted(state, (option,)) for option in options)
        return next((states[0] for states in found if states), state)


def _relates(robot: str, fluent: str, things: set[str]) -> bool:
    arguments = text.arguments(fluent)
    others = [constant for constant in arguments if constant != robot]
    return robot in arguments and bool(others) and things.issuperset(others)


class RandomGoal:
    """Draws an instance of the patterns that does not hold yet; any, if all hold.

    Equal sorts in the patterns stand for one constant.
    """

    def __init__(
        self, world: World, patterns: Iterable[str], sorts: Mapping[str, tuple[str, ...]]
    ) -> None:
        self._world = world
        self._goals = list(_instances(tuple(patterns), sorts))

    def __call__(self, state: int, random: np.random.Generator) -> tuple[str, ...]:
        """The goal of a game that begins in the state."""
        unmet = [goal for goal in self._goals if not self._world.satisfies(state, goal)]
        options = unmet or self._goals
        return options[int(random.integers(len(options)))]


def _instances(
    patterns: tuple[str, ...], sorts: Mapping[str, tuple[str, ...]]
) -> Iterator[tuple[str, ...]]:
    names = list(dict.fromkeys(sort for p in patterns for sort in text.arguments(p)))
    for values in product(*(sorts[name] for name in names)):
        chosen = dict(zip(names, values, strict=True))
        yield tuple(_instance(pattern, chosen) for pattern in patterns)


def _instance(pattern: str, values: Mapping[str, str]) -> str:
    name = pattern.partition("(")[0]
    return text.ground(name, (values[sort] for sort in text.arguments(pattern)))
