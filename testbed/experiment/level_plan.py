"""The trials of a configuration's levels: drawn from the root seed, the level and a number."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import msgspec
import numpy as np

from asp.refinement import Refinement
from testbed.config import ExperimentConfig, grounds, level_size
from testbed.environment import RandomGoal, RandomStart
from testbed.experiment.seeds import generator_of
from testbed.experiment.specs import (
    FineSetting,
    Setting,
    TrialSpec,
    pair_specs,
    setting_of,
)
from testbed.world import world_of

SCENARIO = "levels"
"""What stands in place of a scenario in the records of trials at the fine resolution."""

Drawn = tuple[tuple[str, ...], tuple[str, ...]]


def level_specs(config: ExperimentConfig) -> Iterator[TrialSpec]:
    """The trials in their order: level, number, robot."""
    domain = Path(config.domain).stem
    for level, ground in grounds(config):
        drawing = Drawing(config, ground.refinement)
        texts = [ground.refinement.coarse.text, ground.text] if config.refinement else []
        for number in range(1, (config.limit or 0) + 1):
            place = [level, *texts, number]
            initial, goal = drawing.trial(generator_of(config.seed, place))
            path = [*place, list(initial), sorted(goal)]
            setting = _fine_setting(config, level, goal)
            yield from pair_specs(config, SCENARIO, level, path, initial, setting, domain)


def _fine_setting(config: ExperimentConfig, level: str, goal: tuple[str, ...]) -> Setting:
    fine = FineSetting(
        size=None if config.refinement else level_size(config, level),
        refinement=config.refinement,
        statistics=dict(sorted(config.statistics.items())),
        pace=config.adversary.pace,
    )
    common = setting_of(config, SCENARIO)
    return msgspec.structs.replace(common, goal=goal, fine=fine)


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
