"""What both sides of a coarse game have in common, as a Gymnasium environment."""

from abc import abstractmethod
from collections.abc import Sequence
from typing import Any, ClassVar, TypeAlias, get_args
from typing import Literal as Choice

import gymnasium
import msgspec
import numpy as np
from gymnasium import spaces
from numpy.typing import NDArray

from testbed.config import NO_EVENTS, ConfigError, ExperimentConfig
from testbed.environment import IllegalActionError
from testbed.environment.observation import Observation, Vector
from testbed.environment.options import read_options
from testbed.environment.rendering import MODES, Image
from testbed.experiment.record import COARSE
from testbed.experiment.specs import TrialSpec, setting_of
from testbed.experiment.trial_setup import setup_of
from testbed.office_v0 import Config, raw_env, read_config, whole

Form: TypeAlias = Choice["dict", "flat"]
OF_A_SCENARIO = ("goal", "initial", "goal_feedback", "exogenous_while_thinking")
"""Keys of an environment that a scenario may have of its own."""
SEEDS = 2**31


class Side(gymnasium.Env[Any, Any]):
    """What both sides have in common; `agent` is who acts from outside, `robot` who is the robot.

    A `scenario` of the configuration gives its own goal, start and script, if it has such; without
    one it is the first. With `observations="flat"` these are without the mask.
    """

    metadata: dict[str, Any] = {"render_modes": list(MODES), "render_fps": 2}  # noqa: RUF012
    agent: ClassVar[str]

    def __init__(
        self,
        config: Config,
        robot: str,
        scenario: str | None,
        observations: Form,
        render_mode: str | None,
        **options: Any,
    ) -> None:
        self.config, played = of_scenario(config, scenario, **options)
        self.game = raw_env(self.config, render_mode)
        self.render_mode = render_mode
        check_choice("observations", observations, get_args(Form))
        self._flat = observations == "flat"
        known = self.game.observation_space(self.agent)
        assert isinstance(known, spaces.Dict)
        self.observation_space = known["observation"] if self._flat else known
        self.action_space = self.game.action_space(self.agent)
        setting = setting_of(self.config, played)
        self._setup = setup_of(setting)
        self._trial = TrialSpec(
            trial="",
            pair="",
            scenario=played,
            level=COARSE,
            seed=0,
            robot=robot,
            initial=(),
            domain=self.game.core.world.description.name,
            setting=setting,
        )
        self._games = 0

    def reset(
        self, *, seed: int | None = None, options: dict[str, Any] | None = None
    ) -> tuple[Observation | Vector, dict[str, Any]]:
        """Begin a game; options, and errors, as for `reset` of the AEC environment."""
        chosen = read_options(options)
        super().reset(seed=seed)
        self._games += 1
        trial = chosen.trial or str(self._games)
        self.game.reset(self._draw(), {"initial": chosen.initial, "trial": trial})
        self._begin(self._spec())
        return self._seen(), self.game.infos[self.agent]

    def step(self, action: int) -> tuple[Observation | Vector, float, bool, bool, dict[str, Any]]:
        """Play until it is this side's turn again, or the game is over.

        Raises IllegalActionError, and changes nothing, for an answer that the AEC environment
        refuses, after the end, and after an error of what plays inside.
        """
        game, own = self.game, self.agent
        if not game.agents or self._is_over:
            raise IllegalActionError("the game is over: reset the environment")
        if game.agent_selection != own:  # what plays inside has failed to answer
            raise IllegalActionError("the game cannot go on: reset the environment")
        self._play(action)
        ends = game.terminations[own], game.truncations[own]
        # Since its last answer: the other side's answer comes between.
        earned = float(game._cumulative_rewards[own])
        return self._seen(), earned, *ends, game.infos[own]

    def action_masks(self) -> NDArray[np.bool_]:
        """The legal actions, (A,) of bool, as MaskablePPO asks for them."""
        mask: NDArray[np.bool_] = self.game.observe(self.agent)["action_mask"].astype(np.bool_)
        return mask

    def render(self) -> str | Image | None:
        """As the AEC environment."""
        return self.game.render()

    def close(self) -> None:
        """Close the window, and end what plays inside."""
        self.game.close()

    @abstractmethod
    def _begin(self, spec: TrialSpec) -> None:
        """Begin the game of who plays inside, to whom it is this trial."""

    @abstractmethod
    def _play(self, action: int) -> None:
        """Play this action, and what is inside until it is this side's turn again."""

    def _spec(self) -> TrialSpec:
        core = self.game.core
        name, begun = core.situation.trial, core.world.true_atoms(core.situation.state)
        changed = {"trial": name, "pair": name, "seed": self._draw(), "initial": begun}
        return msgspec.structs.replace(self._trial, **changed)

    def _draw(self) -> int:
        return int(self.np_random.integers(SEEDS))

    def _seen(self) -> Observation | Vector:
        seen = self.game.observe(self.agent)
        return seen["observation"] if self._flat else seen

    @property
    def _is_over(self) -> bool:
        return any(self.game.terminations.values()) or any(self.game.truncations.values())


def check_choice(name: str, given: str, known: Sequence[str]) -> None:
    """Raises ConfigError for a keyword argument that is not one of these."""
    if given not in known:
        raise ConfigError([f"keyword argument: {name}: {given!r}; there are {', '.join(known)}"])


def of_scenario(
    config: Config, scenario: str | None, max_cycles: int | None = None, **options: Any
) -> tuple[ExperimentConfig, str]:
    """The configuration of a scenario's games, and the scenario. Raises ConfigError."""
    read = read_config(config, **options)
    if read.is_fine:
        raise ConfigError([f"{read.name}: is of the fine resolution; give a coarse one"])
    name = str(scenario or "") or next(iter(read.scenarios), NO_EVENTS)
    if name not in (*read.scenarios, NO_EVENTS):
        known = ", ".join(read.scenarios)
        raise ConfigError([f"{read.name}: has no scenario '{name}'; there are {known}"])
    own = read.settings(name)
    limits = {} if max_cycles is None else {"steps": whole("max_cycles", max_cycles)}
    changed = {key: getattr(own, key) for key in OF_A_SCENARIO}
    limited = read.limits.model_copy(update=limits)
    return read.model_copy(update={**changed, "limits": limited}), name
