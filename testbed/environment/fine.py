"""A game at the fine resolution, made of a refinement."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from asp.refinement import Refinement
from testbed.environment.core import Core, DrawGoal
from testbed.environment.execution import Pace, Statistics, UncertainExecution
from testbed.environment.random_start import RandomStart
from testbed.environment.rules import Rules
from testbed.world import sensing_of, world_of

STATISTICS: Statistics = {}
"""A deterministic world with right tests."""


def fine_core(
    refinement: Refinement,
    rules: Rules,
    statistics: Mapping[str, float] = STATISTICS,
    pace: Pace = "concrete",
    initial: Sequence[int] | None = None,
    draw_goal: DrawGoal | None = None,
    holding: float = 0.2,
) -> Core:
    """A game whose robot acts and tests at the fine resolution.

    The goal may have literals of both resolutions. Without `initial` a game begins in a random
    state (`RandomStart`, with its probability of `holding`), and with `draw_goal` it has a goal of
    its own. Raises UnknownFluentError for the goal, ValueError for the statistics.
    """
    world = world_of(refinement)
    robot = refinement.description.robots[0]
    coarse = refinement.coarse_signature.symbols.keys()
    execution = UncertainExecution(world, sensing_of(refinement), robot, statistics, coarse, pace)
    starts = RandomStart(world, robot, holding) if initial is None else initial
    return Core(world, rules, starts, execution, draw_goal)
