"""A game at the fine resolution, made of a refinement."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from functools import cache

from asp.refinement import Refinement
from testbed.environment.core import Core, DrawGoal
from testbed.environment.rules import Rules
from testbed.environment.uncertain_execution import Pace, Statistics, Tested
from testbed.world.initial_states import RandomStart
from testbed.world.matched import SparseWorld
from testbed.world.matched.sensing import Sensing

__all__ = ["Pace", "RandomStart", "Statistics", "fine_core", "fine_world"]

STATISTICS: Statistics = {}
"""A deterministic world with right tests."""


@cache
def fine_world(refinement: Refinement) -> SparseWorld:
    """The world of the weak refinement, compiled once."""
    return SparseWorld(refinement.weak, refinement.weak_signature)


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
    world = fine_world(refinement)
    robot = refinement.description.robots[0]
    sensing = _sensing(refinement)
    coarse = refinement.coarse_signature.symbols.keys()
    execution = Tested(world, sensing, robot, statistics, coarse, pace)
    starts = RandomStart(world, robot, holding) if initial is None else initial
    return Core(world, rules, starts, execution, draw_goal)


@cache
def _sensing(refinement: Refinement) -> Sensing:
    return Sensing(fine_world(refinement), refinement.strong, refinement.strong_signature)
