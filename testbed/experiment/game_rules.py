"""A setting in the environment's terms: the rules of the game, and what the robot knows."""

from __future__ import annotations

from testbed.environment import Rules
from testbed.experiment.specs import Setting
from testbed.world import World


def known(setting: Setting, world: World, state: int) -> tuple[str, ...]:
    """What the robot knows of the initial state."""
    if setting.knowledge == "complete":
        return world.literals(state)
    return world.visible(state, world.description.robots[0])


def rules_of(setting: Setting) -> Rules:
    """The rules of the game."""
    return Rules(
        goal=setting.goal,
        steps=setting.step_limit,
        observability=setting.observability,
        goal_feedback=setting.goal_feedback,
        exogenous_while_thinking=setting.exogenous_while_thinking,
    )
