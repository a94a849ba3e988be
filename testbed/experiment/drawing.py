"""What a trial at the fine resolution draws: where everything is at the start, and the goal."""

from __future__ import annotations

import numpy as np

from asp.refinement import Refinement
from testbed.config import ExperimentConfig
from testbed.environment import RandomGoal, RandomStart
from testbed.world import world_of

Drawn = tuple[tuple[str, ...], tuple[str, ...]]


class Drawing:
    """Draws the trials of one level: what the configuration gives is not drawn."""

    def __init__(self, config: ExperimentConfig, refinement: Refinement) -> None:
        description = refinement.description
        self._world = world_of(refinement)
        self._start = RandomStart(self._world, description.robots[0], config.draw.holding)
        self._initial = config.initial
        self._goal = config.goal
        patterns, sorts = config.draw.goal, description.sorts
        self._draw_goal = None if config.goal else RandomGoal(self._world, patterns, sorts)

    def trial(self, generator: np.random.Generator) -> Drawn:
        """The inertial atoms true at the start, and a goal that does not hold there."""
        given = self._initial
        state = self._start(generator) if given is None else self._world.state(given)
        true = frozenset(self._world.true_atoms(state))
        inertial = true.intersection(self._world.description.inertial)
        draw = self._draw_goal
        return tuple(sorted(inertial)), self._goal if draw is None else draw(state, generator)
