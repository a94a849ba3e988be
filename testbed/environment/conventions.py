"""How an environment talks to what plays in it; the game is the same under all conventions."""

from collections.abc import Collection
from dataclasses import dataclass
from typing import Any

import numpy as np
from gymnasium import spaces
from numpy.typing import NDArray

from asp.language import Action
from testbed.environment.core import Core
from testbed.environment.observation import Observation, vector
from testbed.environment.rules import ADVERSARY, ROBOT, Ending, Illegal, Infos

OUTCOMES = (None, *Ending)
"""Outcomes by number in numeric infos; 0: the game goes on."""


@dataclass(frozen=True)
class Conventions:
    """Conventions of an environment.

    `infos`: arrays and numbers, or literals and the robot's percept. `illegal`: what an answer
    outside the mask does: it raises IllegalActionError, counts as action 0, or ends the game.
    `padded`: both agents have observations of one shape, and as many actions; what an agent lacks
    is 0 in its observation and in its mask.
    """

    infos: Infos = "numeric"
    illegal: Illegal = "error"
    padded: bool = False


def infos(
    core: Core, robot_action: Action | None, illegal: Collection[str], kind: Infos
) -> dict[str, dict[str, Any]]:
    """What each agent is told beside its observation; `illegal` are those whose last answer was."""
    told = (_text if kind == "text" else _numeric)(core, robot_action)
    return {agent: {**own, "illegal": int(agent in illegal)} for agent, own in told.items()}


def _text(core: Core, robot_action: Action | None) -> dict[str, dict[str, Any]]:
    """What each agent sees, as ASP text: the robot's percept, the adversary's full view.

    Both know the goal; `outcome` is None until the game is over.
    """
    percept = core.percept
    both = {"goal": list(core.situation.goal), "outcome": core.situation.ending}
    everything = list(core.world.literals(core.situation.state))
    return {
        ROBOT: {"literals": percept.visible, "percept": percept, **both},
        ADVERSARY: {"literals": everything, "robot_action": robot_action, **both},
    }


def _numeric(core: Core, robot_action: Action | None) -> dict[str, dict[str, Any]]:
    now, fluents = core.situation, core.world.fluents
    both = {"step": now.step, "outcome": OUTCOMES.index(now.ending)}
    happened = 0 if now.happened is None else 1 if now.happened else -1
    holds = -1 if now.goal_holds is False else 0
    chosen = -1 if robot_action is None else core.robot_actions.index(robot_action)
    return {
        ROBOT: {
            **both,
            "goal": vector(fluents, now.goal),
            "happened": happened,
            "goal_holds": holds,
        },
        ADVERSARY: {**both, "goal": vector(fluents, now.goal), "robot_action": chosen},
    }


def padded(observation: Observation, space: spaces.Dict) -> Observation:
    """An observation with zeros behind each part, in this space."""
    return {name: _long(part, space[name]) for name, part in observation.items()}


def _long(part: NDArray[Any], space: spaces.Space[Any]) -> NDArray[Any]:
    assert space.shape is not None
    return np.pad(part, (0, space.shape[0] - len(part))).astype(space.dtype)
