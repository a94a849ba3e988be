"""What the AEC and the parallel environment have in common: the spaces and looks of a core."""

from dataclasses import replace
from typing import Any, ClassVar

from gymnasium import spaces

from asp.language import suggestion
from testbed.environment.core import Core
from testbed.environment.observation import Vector, observation_spaces, signs, state_vector
from testbed.environment.rendering import MODES, Image, html_of, render
from testbed.environment.rules import ADVERSARY, ROBOT, UnknownOptionError, check_agent

OPTIONS = ("initial", "trial")
"""The keys of `reset(options=...)`."""
_PROBE = "options"
"""A key that PettingZoo's own tests give, and that means nothing."""


class View:
    """A core as PettingZoo shows it. Raises ValueError for an unknown render mode."""

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
        self.observation_spaces = observation_spaces(core)
        self.action_spaces: dict[str, spaces.Space[Any]] = {
            ROBOT: spaces.Discrete(len(core.robot_actions)),
            ADVERSARY: spaces.Discrete(len(core.adversary_actions)),
        }
        self.state_space = signs(len(core.world.fluents))

    @property
    def max_cycles(self) -> int:
        """The number of the last step of a game."""
        return self.core.rules.steps

    @max_cycles.setter
    def max_cycles(self, steps: int) -> None:
        self.core.rules = replace(self.core.rules, steps=steps)

    def observation_space(self, agent: str) -> spaces.Space[Any]:
        """The same object on every call. Raises UnknownAgentError."""
        check_agent(agent)
        return self.observation_spaces[agent]

    def action_space(self, agent: str) -> spaces.Space[Any]:
        """The same object on every call. Raises UnknownAgentError."""
        check_agent(agent)
        return self.action_spaces[agent]

    def state(self) -> Vector:
        """The true state, one entry per fluent: 1 true, -1 false. Raises NotResetError."""
        return state_vector(self.core)

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
