"""One agent's side of a coarse game as a Gymnasium environment; the other plays inside of it."""

from abc import abstractmethod
from collections.abc import Sequence
from contextlib import ExitStack
from typing import Any, ClassVar, SupportsInt, TypeAlias, get_args
from typing import Literal as Choice

import gymnasium
import numpy as np
from gymnasium import spaces
from numpy.typing import NDArray

from agents.adversary import Adversary
from testbed.config import NO_EVENTS, ConfigError, ExperimentConfig
from testbed.environment import ADVERSARY, ROBOT, IllegalActionError
from testbed.environment.observation import Observation, Vector
from testbed.environment.options import read_options
from testbed.environment.rendering import MODES, Image
from testbed.experiment.adversaries import AdversaryError
from testbed.experiment.record import COARSE
from testbed.experiment.robots import make_robot
from testbed.experiment.specs import TrialSpec, setting_of
from testbed.experiment.trial import adversary_view
from testbed.experiment.trial_setup import setup_of
from testbed.learning.remembered import Remembered
from testbed.link import connect
from testbed.office_v0 import Config, raw_env, read_config, whole
from testbed.protocol import WAIT, Decision, RobotClient, RobotLost, Trace

Form: TypeAlias = Choice["dict", "flat"]
Link: TypeAlias = Choice["inprocess", "zenoh"]
OF_A_SCENARIO = ("goal", "initial", "goal_feedback", "exogenous_while_thinking")
"""Keys of an environment that a scenario may have of its own."""
SEEDS = 2**31


class _Side(gymnasium.Env[Any, Any]):
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
        self.config, self._scenario = _of_scenario(config, scenario, **options)
        self.game = raw_env(self.config, render_mode)
        self.render_mode = render_mode
        _check("observations", observations, get_args(Form))
        self._robot, self._flat = robot, observations == "flat"
        known = self.game.observation_space(self.agent)
        assert isinstance(known, spaces.Dict)
        self.observation_space = known["observation"] if self._flat else known
        self.action_space = self.game.action_space(self.agent)
        self._setting = setting_of(self.config, self._scenario)
        self._setup = setup_of(self._setting)
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

    def step(
        self, action: SupportsInt
    ) -> tuple[Observation | Vector, float, bool, bool, dict[str, Any]]:
        """Play until it is this side's turn again, or the game is over.

        Raises IllegalActionError after the end, and after an error of what plays inside.
        """
        game, own = self.game, self.agent
        if not game.agents or self._is_over:
            raise IllegalActionError("the game is over: reset the environment")
        if game.agent_selection != own:  # what plays inside has failed to answer
            raise IllegalActionError("the game cannot go on: reset the environment")
        self._play(int(action))
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
        return TrialSpec(
            trial=core.situation.trial,
            pair=core.situation.trial,
            scenario=self._scenario,
            level=COARSE,
            seed=self._draw(),
            robot=self._robot,
            initial=core.world.true_atoms(core.situation.state),
            domain=core.world.description.name,
            setting=self._setting,
        )

    def _draw(self) -> int:
        return int(self.np_random.integers(SEEDS))

    def _seen(self) -> Observation | Vector:
        seen = self.game.observe(self.agent)
        return seen["observation"] if self._flat else seen

    @property
    def _is_over(self) -> bool:
        return any(self.game.terminations.values()) or any(self.game.truncations.values())


class AdversaryEnv(_Side):
    """The adversary's side of games against a robot: `gymnasium.make("testbed/Adversary-v0")`.

    `robot` is a name, or `module:Class`. By `link` it thinks in this process, or in a process of
    its own behind zenoh, which ends with `close`. Its answer is in what the adversary sees. With
    `remember` it is asked only after histories in which it has not answered before: then its
    answers have to follow from task and percepts, and its seed is 0 in each game.
    Configuration and options are those of `office_v0.env`.

    Raises:
        ConfigError: for a bad configuration, and for one of the fine resolution.
        RobotLost: by `reset` and `step`, where the robot fails.
        UnlikeError: by these, where a remembered robot answers otherwise than before.
    """

    agent = ADVERSARY

    def __init__(
        self,
        config: Config = None,
        robot: str = "intentional",
        link: Link = "inprocess",
        remember: bool = False,
        scenario: str | None = None,
        observations: Form = "dict",
        render_mode: str | None = None,
        **options: Any,
    ) -> None:
        super().__init__(config, robot, scenario, observations, render_mode, **options)
        _check("link", link, get_args(Link))
        self._link, self._remembers = link, remember
        self._client: RobotClient | None = None
        self._memory: Remembered | None = None
        self._open = ExitStack()

    @property
    def asked(self) -> int | None:
        """How often a remembered robot was asked since it was connected; None of another one."""
        return None if self._memory is None else self._memory.asked

    def close(self) -> None:
        self._open.close()
        self._client = self._memory = None
        super().close()

    def _begin(self, spec: TrialSpec) -> None:
        if self._client is None:
            seconds = self.config.limits.answer_s
            link = connect(self._link, make_robot, self.config.name, seconds)
            self._client = self._open.enter_context(link)
            self._memory = Remembered(self._client) if self._remembers else None
        seed = 0 if self._remembers else spec.seed
        task = self._setup.task(spec, self.game.core.situation.state, seed)
        (self._memory or self._client).begin(task)
        self._let_robot_answer()

    def _play(self, action: int) -> None:
        self.game.step(action)
        if not self._is_over:
            self._let_robot_answer()

    def _let_robot_answer(self) -> None:
        core, memory, client = self.game.core, self._memory, self._client
        assert client is not None
        percept = core.percept
        answer = memory.answer(percept) if memory else client.ask(percept).action
        if answer not in core.robot_actions:
            raise RobotLost(f"answered '{answer}', which is not an action")
        self.game.step(core.robot_actions.index(answer))


class RobotEnv(_Side):
    """The robot's side of games against an adversary: `gymnasium.make("testbed/Robot-v0")`.

    The adversary is that of the configuration: its script, `adversary.strategy`, or the triggers of
    the scenario. Configuration and options are those of `office_v0.env`.

    Raises:
        ConfigError: for a bad configuration, and for one of the fine resolution.
        AdversaryError: by `reset` and `step`, where the adversary fails.
    """

    agent = ROBOT

    def __init__(
        self,
        config: Config = None,
        scenario: str | None = None,
        observations: Form = "dict",
        render_mode: str | None = None,
        **options: Any,
    ) -> None:
        super().__init__(config, "learner", scenario, observations, render_mode, **options)
        self._adversary: Adversary | None = None

    def _begin(self, spec: TrialSpec) -> None:
        self._adversary = self._setup.adversary(spec)
        self._adversary.reset(spec.seed)

    def _play(self, action: int) -> None:
        assert self._adversary is not None
        core, sees = self.game.core, self._adversary.sees
        self.game.step(action)
        if self._is_over:  # by an illegal answer
            return
        is_action = action < len(core.robot_actions)
        decision = Decision(
            trial=core.situation.trial,
            step=core.situation.step,
            action=core.robot_actions[action] if is_action else WAIT,
            believes_goal=False,
            trace=Trace(),
        )
        event = self._adversary.act(adversary_view(core, decision, sees))
        known = event in core.adversary_actions
        why = core.why_not(decision.action, event) if known else "it is not an exogenous action"
        if why is not None:
            raise AdversaryError(f"{event} beside {decision.action}: {why}")
        self.game.step(core.adversary_actions.index(event))


def _check(name: str, given: str, known: Sequence[str]) -> None:
    if given not in known:
        raise ConfigError([f"keyword argument: {name}: {given!r}; there are {', '.join(known)}"])


def _of_scenario(
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
