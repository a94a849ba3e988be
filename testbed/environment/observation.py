"""Observations of a game: vectors for learners, literals for reasoners, and pictures."""

from collections.abc import Sequence
from typing import Any, ClassVar, TypeAlias

import numpy as np
from gymnasium import spaces
from numpy.typing import NDArray

from asp.language import Action, Fluent, Literal, suggestion
from testbed.environment.core import Core
from testbed.environment.rendering import MODES, Image, html_of, render
from testbed.environment.rules import ADVERSARY, ROBOT, UnknownOptionError, known_agent
from testbed.protocol import NONE, WAIT

Vector: TypeAlias = NDArray[np.int8 | np.int32]
Observation: TypeAlias = dict[str, Vector]
"""`observation` and `action_mask`, as the spaces say."""
OPTIONS = ("initial", "trial")
"""The keys of `reset(options=...)`."""
_PROBE = "options"
"""A key that PettingZoo's own tests give, and that means nothing."""


def observe(core: Core, agent: str, robot_action: Action | None) -> Observation:
    """The agent's observation; `robot_action` is the robot's answer, if it has given it.

    Raises UnknownAgentError, and NotResetError before the first game.
    """
    world, own, legal = core.world, core.robot_actions, core.robot_actions
    if known_agent(agent) == ROBOT:
        seen = vector(world.fluents, core.visible)
    else:
        state = vector(world.fluents, world.literals(core.situation.state))
        seen = np.concatenate([state, _mask(core.robot_actions, (robot_action,))])
        if core.allowance.highest:
            left = np.array(core.allowance.entries(core.left), _dtype(core))
            seen = np.concatenate([seen, left], dtype=left.dtype)
        own, legal = core.adversary_actions, core.events(robot_action)
    if core.situation.ending is not None:
        # A mask without any action would be sampled as action 0 without a word.
        legal = (WAIT, NONE)
    return {"observation": seen, "action_mask": _mask(own, legal)}


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


def vector(fluents: Sequence[Fluent], literals: Sequence[Literal]) -> Vector:
    """One entry per fluent: 1 true, -1 false, 0 where no literal is about it."""
    known = {seen.atom: 1 if seen.is_positive else -1 for seen in literals}
    return np.array([known.get(fluent, 0) for fluent in fluents], np.int8)


def _dtype(core: Core) -> type[np.int8 | np.int32]:
    """The type of the adversary's observation: the smaller one, where it holds what is left."""
    return np.int8 if max(core.allowance.highest, default=0) <= np.iinfo(np.int8).max else np.int32


def _mask(names: Sequence[str], chosen: Sequence[str | None]) -> Vector:
    return np.array([name in chosen for name in names], np.int8)


def _box(size: int, left: Sequence[int], dtype: type[np.int8 | np.int32]) -> spaces.Box:
    """The space of a state, an action, and of what is left, from 0 to these numbers."""
    if not left:
        return spaces.Box(-1, 1, (size,), np.int8)
    low, high = [-1] * size + [0] * len(left), [1] * size + [*left]
    return spaces.Box(np.array(low, dtype), np.array(high, dtype), dtype=dtype)


class View:
    """A core as PettingZoo shows it. Raises ValueError for an unknown render mode.

    An observation has one entry per fluent: 1 true, 0 unknown, -1 false; then, for the adversary,
    one entry per action of the robot: 1 for the chosen one, and what is left of its budget, its
    cooldown, and each object's events, where the rules bound these. Beside it stands the mask over
    the agent's own actions.
    """

    metadata: ClassVar[dict[str, Any]] = {
        "name": "office_v0",
        "render_modes": list(MODES),
        "render_fps": 2,
        # PettingZoo's conversion would show the adversary a mask from before the robot's answer,
        # and the environment refuse what it then picks: there is a parallel view of our own.
        "is_parallelizable": False,
    }

    def __init__(self, core: Core, render_mode: str | None = None) -> None:
        if render_mode not in (None, *MODES):
            raise ValueError(f"{render_mode!r} is not a render mode; there are {', '.join(MODES)}")
        self.core = core
        self.render_mode = render_mode
        self.possible_agents = [ROBOT, ADVERSARY]
        self.agents: list[str] = []
        self.observation_spaces: dict[str, spaces.Space[Any]] = {}
        self.action_spaces: dict[str, spaces.Space[Any]] = {}
        fluents, robot = len(core.world.fluents), len(core.robot_actions)
        known, left = spaces.Box(-1, 1, (fluents,), np.int8), core.allowance.highest
        for agent, vector, actions in (
            (ROBOT, known, robot),
            (ADVERSARY, _box(fluents + robot, left, _dtype(core)), len(core.adversary_actions)),
        ):
            mask = spaces.MultiBinary(actions)
            both: dict[str, spaces.Space[Any]] = {"observation": vector, "action_mask": mask}
            self.observation_spaces[agent] = spaces.Dict(both)
            self.action_spaces[agent] = spaces.Discrete(actions)
        self.state_space = spaces.Box(-1, 1, (fluents,), np.int8)

    def observation_space(self, agent: str) -> spaces.Space[Any]:
        """The same object on every call. Raises UnknownAgentError."""
        return self.observation_spaces[known_agent(agent)]

    def action_space(self, agent: str) -> spaces.Space[Any]:
        """The same object on every call. Raises UnknownAgentError."""
        return self.action_spaces[known_agent(agent)]

    def state(self) -> Vector:
        """The true state, one entry per fluent: 1 true, -1 false. Raises NotResetError."""
        world = self.core.world
        return vector(world.fluents, world.literals(self.core.situation.state))

    def render(self) -> str | Image | None:
        """`ansi`: text; `rgb_array`: a picture (height, width, 3) of uint8; `human`: prints.

        Raises NotResetError.
        """
        self._check_begun()
        return render(self.core, self.render_mode)

    def _repr_html_(self) -> str:
        """What a notebook shows: the picture, the goal, and how the game stands."""
        return html_of(self.core)

    def close(self) -> None:
        """Nothing is held: no window, no process, no connection."""

    def _check_begun(self) -> None:
        """Raises NotResetError before the first game."""
        _ = self.core.situation

    def _begin(self, seed: int | None, options: dict[str, Any] | None) -> None:
        """Begins a game; of the options `initial` are literals and `trial` an id, both optional."""
        chosen = options or {}
        for key in chosen:
            if key not in (*OPTIONS, _PROBE):
                near = suggestion(key, OPTIONS)
                raise UnknownOptionError(f"reset: {key!r} is not an option; {near}")
        self.core.reset(seed, chosen.get("initial"), chosen.get("trial", ""))
        self.agents = list(self.possible_agents)

    def _ends(self) -> tuple[dict[str, bool], dict[str, bool]]:
        """Terminations and truncations: agents end together, the first by the robot's answer."""
        ending = self.core.situation.ending
        terminated = ending is not None and ending.by_answer
        truncated = ending is not None and not ending.by_answer
        both = self.possible_agents
        return dict.fromkeys(both, terminated), dict.fromkeys(both, truncated)
