"""Random initial states of a world that has too many to list."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from asp.language import literals as text
from testbed.world.matched.world import SparseWorld


class RandomStart:
    """Draws an initial state: a value for each thing that must have one, as `initially` says.

    With probability `holding` the robot stands in a relation, such as holding, to one of the things
    that must be somewhere. What follows from that is not drawn again.
    """

    def __init__(self, world: SparseWorld, robot: str, holding: float = 0.2) -> None:
        self._world = world
        self._holding = holding
        self._groups = groups = world.description.initially
        bits = {fluent: 1 << number for number, fluent in enumerate(world.fluents)}
        self._masks = [sum(bits[fluent] for fluent in some) for some in self._groups]
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
        for some, mask in zip(self._groups, self._masks, strict=True):
            if not state & mask:
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
