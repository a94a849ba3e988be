"""Observations of a game as vectors."""

from collections.abc import Sequence
from typing import TypeAlias

import numpy as np
from numpy.typing import NDArray

from asp.language import Action, Fluent, Literal
from testbed.environment.core import Core
from testbed.environment.rules import ROBOT, known_agent
from testbed.protocol import NONE, WAIT

Vector: TypeAlias = NDArray[np.int8 | np.int32]
Observation: TypeAlias = dict[str, Vector]
"""`observation` and `action_mask`, as the spaces say."""


def observe(core: Core, agent: str, robot_action: Action | None, over: bool = False) -> Observation:
    """The agent's observation; `robot_action` is the robot's answer, if it has given it.

    Where the game is `over`, also by something else than its own ending, the mask holds action 0.
    Raises UnknownAgentError, and NotResetError before the first game.
    """
    world, own, legal = core.world, core.robot_actions, core.robot_actions
    if known_agent(agent) == ROBOT:
        seen = vector(world.fluents, core.visible)
    else:
        state = vector(world.fluents, world.literals(core.situation.state))
        seen = np.concatenate([state, _mask(core.robot_actions, (robot_action,))])
        if core.allowance.highest:
            left = np.array(core.allowance.entries(core.left), dtype_of(core))
            seen = np.concatenate([seen, left], dtype=left.dtype)
        own, legal = core.adversary_actions, core.events(robot_action)
    if over or core.situation.ending is not None:
        # A mask without any action would be sampled as action 0 without a word.
        legal = (WAIT, NONE)
    return {"observation": seen, "action_mask": _mask(own, legal)}


def vector(fluents: Sequence[Fluent], literals: Sequence[Literal]) -> Vector:
    """One entry per fluent: 1 true, -1 false, 0 where no literal is about it."""
    known = {seen.atom: 1 if seen.is_positive else -1 for seen in literals}
    return np.array([known.get(fluent, 0) for fluent in fluents], np.int8)


def dtype_of(core: Core) -> type[np.int8 | np.int32]:
    """The type of the adversary's observation: the smaller one, where it holds what is left."""
    return np.int8 if max(core.allowance.highest, default=0) <= np.iinfo(np.int8).max else np.int32


def _mask(names: Sequence[str], chosen: Sequence[str | None]) -> Vector:
    return np.array([name in chosen for name in names], np.int8)
