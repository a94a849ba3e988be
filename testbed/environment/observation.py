"""What each agent sees of a game: vectors for learners, literals for reasoners."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, TypeAlias

import numpy as np
from gymnasium import spaces
from numpy.typing import NDArray

from asp.language import literals as text
from testbed.environment.agents import ADVERSARY, ROBOT, check_agent
from testbed.environment.core import Core
from testbed.environment.legality import NONE, WAIT

Vector: TypeAlias = NDArray[np.int8]
Observation: TypeAlias = dict[str, Vector]
"""`observation` and `action_mask`, as the spaces say."""


def observation_spaces(core: Core) -> dict[str, spaces.Space[Any]]:
    """One entry a fluent: 1 true, 0 unknown, -1 false; then, for the adversary, one entry an
    action of the robot: 1 for the chosen one. Beside it the mask over the agent's own actions.
    """
    fluents = len(core.world.fluents)
    robot, adversary = len(core.robot_actions), len(core.adversary_actions)
    return {
        ROBOT: _masked(fluents, robot),
        ADVERSARY: _masked(fluents + robot, adversary),
    }


def action_spaces(core: Core) -> dict[str, spaces.Space[Any]]:
    """The robot: wait, finish, its actions; the adversary: none, exogenous actions."""
    return {
        ROBOT: spaces.Discrete(len(core.robot_actions)),
        ADVERSARY: spaces.Discrete(len(core.adversary_actions)),
    }


def state_space(core: Core) -> spaces.Box:
    """One entry a fluent: 1 true, -1 false."""
    return _signs(len(core.world.fluents))


def observe(core: Core, agent: str, robot_action: str | None) -> Observation:
    """The agent's observation; `robot_action` is the robot's answer, if it has given it.

    Raises UnknownAgentError, and NotResetError before the first game.
    """
    check_agent(agent)
    return _robot(core) if agent == ROBOT else _adversary(core, robot_action)


def state_vector(core: Core) -> Vector:
    """The true state, shaped as `state_space`."""
    return _vector(core.world.fluents, core.world.literals(core.situation.state))


def infos(core: Core, robot_action: str | None) -> dict[str, dict[str, Any]]:
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


def _robot(core: Core) -> Observation:
    return {
        "observation": _vector(core.world.fluents, core.visible),
        "action_mask": _mask(core.robot_actions, _live(core, core.robot_actions)),
    }


def _adversary(core: Core, robot_action: str | None) -> Observation:
    chosen = () if robot_action is None else (robot_action,)
    return {
        "observation": np.concatenate([state_vector(core), _mask(core.robot_actions, chosen)]),
        "action_mask": _mask(core.adversary_actions, _live(core, core.events(robot_action))),
    }


def _live(core: Core, legal: Sequence[str]) -> Sequence[str]:
    """What is legal while the game goes on; once it is over, doing nothing.

    A mask without any action would be sampled as action 0 without a word.
    """
    return legal if core.situation.ending is None else (WAIT, NONE)


def _vector(fluents: Sequence[str], literals: Sequence[str]) -> Vector:
    known = {text.atom(seen): 1 if text.is_positive(seen) else -1 for seen in literals}
    return np.array([known.get(fluent, 0) for fluent in fluents], np.int8)


def _mask(names: Sequence[str], chosen: Sequence[str]) -> Vector:
    return np.array([name in chosen for name in names], np.int8)


def _masked(length: int, actions: int) -> spaces.Dict:
    return spaces.Dict({"observation": _signs(length), "action_mask": spaces.MultiBinary(actions)})


def _signs(length: int) -> spaces.Box:
    return spaces.Box(-1, 1, (length,), np.int8)
