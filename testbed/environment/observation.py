"""What each agent sees of a game: vectors for learners, literals for reasoners."""

from collections.abc import Sequence
from typing import Any, TypeAlias

import numpy as np
from gymnasium import spaces
from numpy.typing import NDArray

from asp.language import Action, Fluent, Literal
from testbed.environment.core import Core
from testbed.environment.rules import ADVERSARY, ROBOT, check_agent
from testbed.protocol import NONE, WAIT

Vector: TypeAlias = NDArray[np.int8]
Observation: TypeAlias = dict[str, Vector]
"""`observation` and `action_mask`, as the spaces say."""


def observation_spaces(core: Core) -> dict[str, spaces.Space[Any]]:
    """One entry a fluent: 1 true, 0 unknown, -1 false; then, for the adversary, one entry an
    action of the robot: 1 for the chosen one. Beside it the mask over the agent's own actions.
    """
    fluents, robot = len(core.world.fluents), len(core.robot_actions)
    lengths = {ROBOT: (fluents, robot), ADVERSARY: (fluents + robot, len(core.adversary_actions))}
    return {
        agent: spaces.Dict({"observation": signs(seen), "action_mask": spaces.MultiBinary(actions)})
        for agent, (seen, actions) in lengths.items()
    }


def signs(length: int) -> spaces.Box:
    """The space of vectors with this many entries of -1, 0, and 1."""
    return spaces.Box(-1, 1, (length,), np.int8)


def observe(core: Core, agent: str, robot_action: Action | None) -> Observation:
    """The agent's observation; `robot_action` is the robot's answer, if it has given it.

    Raises UnknownAgentError, and NotResetError before the first game.
    """
    check_agent(agent)
    own = legal = core.robot_actions
    if agent == ROBOT:
        seen = _vector(core.world.fluents, core.visible)
    else:
        chosen = () if robot_action is None else (robot_action,)
        seen = np.concatenate([state_vector(core), _mask(core.robot_actions, chosen)])
        own, legal = core.adversary_actions, core.events(robot_action)
    if core.situation.ending is not None:
        # A mask without any action would be sampled as action 0 without a word.
        legal = (WAIT, NONE)
    return {"observation": seen, "action_mask": _mask(own, legal)}


def state_vector(core: Core) -> Vector:
    """The true state, shaped as `state_space`."""
    return _vector(core.world.fluents, core.world.literals(core.situation.state))


def infos(core: Core, robot_action: Action | None) -> dict[str, dict[str, Any]]:
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


def _vector(fluents: Sequence[Fluent], literals: Sequence[Literal]) -> Vector:
    known = {seen.atom: 1 if seen.is_positive else -1 for seen in literals}
    return np.array([known.get(fluent, 0) for fluent in fluents], np.int8)


def _mask(names: Sequence[str], chosen: Sequence[str]) -> Vector:
    return np.array([name in chosen for name in names], np.int8)
