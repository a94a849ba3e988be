"""What both environments have in common: spaces, conventions, pictures, and how a game begins."""

from collections.abc import Iterable, Mapping
from typing import Any, ClassVar

import numpy as np
from gymnasium import spaces

from asp.language import Action
from testbed.environment.conventions import Conventions, infos, padded
from testbed.environment.core import Core
from testbed.environment.observation import Observation, Vector, dtype_of, observe, vector
from testbed.environment.options import read_options
from testbed.environment.rendering import MODES, Image, Window, html_of, render
from testbed.environment.rules import ADVERSARY, ROBOT, Ending, NotResetError, known_agent, name_of

DEFAULT = Conventions()


class View:
    """A core as PettingZoo shows it, by conventions. Raises ValueError for an unknown render mode.

    An observation has one entry per fluent: 1 true, 0 unknown, -1 false; then, for the adversary,
    one entry per action of the robot: 1 for the chosen one, and what is left of its budget, its
    cooldown, and each object's events, where the rules bound these. Beside it stands the mask over
    the agent's own actions.
    """

    _illegal: tuple[str, ...] = ()
    """The agents whose last answer was illegal, in their order."""

    metadata: ClassVar[dict[str, Any]] = {
        "name": "office_v0",
        "render_modes": list(MODES),
        "render_fps": 2,
        # PettingZoo's conversion would show the adversary a mask from before the robot's answer,
        # and the environment refuse what it then picks: there is a parallel view of our own.
        "is_parallelizable": False,
    }

    def __init__(
        self, core: Core, render_mode: str | None = None, conventions: Conventions = DEFAULT
    ) -> None:
        if render_mode not in (None, *MODES):
            raise ValueError(f"{render_mode!r} is not a render mode; there are {', '.join(MODES)}")
        self.core = core
        self.render_mode = render_mode
        self.conventions = conventions
        self._window = Window(self.metadata["name"])
        self.possible_agents = [ROBOT, ADVERSARY]
        self.agents: list[str] = []
        self.observation_spaces: dict[str, spaces.Space[Any]] = {}
        self.action_spaces: dict[str, spaces.Space[Any]] = {}
        self._actions: Mapping[str, tuple[Action, ...]] = {
            ROBOT: core.robot_actions,
            ADVERSARY: core.adversary_actions,
        }
        boxes = _boxes(core)
        actions = {agent: len(own) for agent, own in self._actions.items()}
        if conventions.padded:
            boxes = dict.fromkeys(boxes, _around(boxes.values()))
            actions = dict.fromkeys(actions, max(actions.values()))
        for agent, known in boxes.items():
            mask = spaces.MultiBinary(actions[agent])
            self.observation_spaces[agent] = spaces.Dict(
                {"observation": known, "action_mask": mask}
            )
            self.action_spaces[agent] = spaces.Discrete(actions[agent])
        fluents = len(core.world.fluents)
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
        """`ansi`: text; `rgb_array`: a picture (height, width, 3) of uint8; `human`: a window.

        Where there is no screen, `human` prints. Raises NotResetError.
        """
        self._check_begun()
        return render(self.core, self.render_mode, self._window)

    def _repr_html_(self) -> str:
        """What a notebook shows: the picture, the goal, and how the game stands."""
        return html_of(self.core)

    def close(self) -> None:
        """Close the window; nothing else is held, no process and no connection."""
        self._window.close()

    def __getstate__(self) -> dict[str, Any]:
        """A copy has a window of its own."""
        return {**vars(self), "_window": Window(self.metadata["name"])}

    def _observed(self, agent: str, robot_action: Action | None) -> Observation:
        found = observe(self.core, agent, robot_action, over=self._is_stopped)
        if not self.conventions.padded:
            return found
        space = self.observation_spaces[agent]
        assert isinstance(space, spaces.Dict)
        return padded(found, space)

    def _infos(self, robot_action: Action | None) -> dict[str, dict[str, Any]]:
        return infos(self.core, robot_action, self._illegal, self.conventions.infos)

    def _named(self, agent: str, answer: Any) -> Action:
        """The action of an answer. Raises IllegalActionError, also for the padding of a mask."""
        return name_of(agent, answer, self._actions[agent])

    def _tolerates(self, agent: str, answer: Any) -> bool:
        """Whether an illegal answer is not an error, as it is at least one of the action space."""
        known = self.action_spaces[agent].contains(answer)
        return known and self.conventions.illegal != "error"

    @property
    def _is_stopped(self) -> bool:
        """Whether an illegal answer has ended the game."""
        return bool(self._illegal) and self.conventions.illegal == "terminate"

    def _check_begun(self) -> None:
        """Raises NotResetError before the first game."""
        if self.core.now is None:
            raise NotResetError

    def _begin(self, seed: int | None, options: dict[str, Any] | None) -> None:
        """Begins a game."""
        chosen = read_options(options)
        self.core.reset(seed, chosen.initial, chosen.trial)
        self.agents = list(self.possible_agents)
        self._illegal = ()

    def _ends(self, ending: Ending | None) -> tuple[dict[str, bool], dict[str, bool]]:
        """Terminations and truncations: agents end together, the first by the robot's answer."""
        terminated = ending is not None and ending.by_answer
        truncated = ending is not None and not ending.by_answer
        both = self.possible_agents
        return dict.fromkeys(both, terminated), dict.fromkeys(both, truncated)


def _boxes(core: Core) -> dict[str, spaces.Box]:
    """The space of each agent's observation without its mask."""
    fluents, left = len(core.world.fluents), core.allowance.highest
    size = fluents + len(core.robot_actions)
    low, high = [-1] * size + [0] * len(left), [1] * size + [*left]
    kind = dtype_of(core)
    return {
        ROBOT: spaces.Box(-1, 1, (fluents,), np.int8),
        ADVERSARY: spaces.Box(np.array(low, kind), np.array(high, kind), dtype=kind),
    }


def _around(boxes: Iterable[spaces.Box]) -> spaces.Box:
    """The smallest space that has the entries of each in front, and zeros behind them."""
    known = list(boxes)
    size, kind = max(box.shape[0] for box in known), np.result_type(*(box.dtype for box in known))
    low = np.minimum.reduce([np.pad(box.low, (0, size - len(box.low))) for box in known])
    high = np.maximum.reduce([np.pad(box.high, (0, size - len(box.high))) for box in known])
    return spaces.Box(low.astype(kind), high.astype(kind), dtype=kind.type)
