"""One agent's side of a coarse game as a Gymnasium environment; the other plays inside of it."""

from contextlib import ExitStack
from typing import Any, TypeAlias, get_args
from typing import Literal as Choice

from agents.adversary import Adversary
from testbed.environment import ADVERSARY, ROBOT
from testbed.experiment.adversaries import AdversaryError
from testbed.experiment.robots import make_robot
from testbed.experiment.specs import TrialSpec
from testbed.experiment.trial import adversary_view
from testbed.learning.checks import check_adversary, check_robot
from testbed.learning.remembered import Remembered
from testbed.learning.sides import Form, Side, check_choice
from testbed.learning.table_robots import Table, is_table, table_of
from testbed.link import connect
from testbed.office_v0 import Config
from testbed.protocol import Decision, RobotClient, RobotLost, Trace

Link: TypeAlias = Choice["inprocess", "zenoh"]


class AdversaryEnv(Side):
    """The adversary's side of games against a robot: `gymnasium.make("testbed/Adversary-v0")`.

    `robot` is a name, or `module:Class`. By `link` it thinks in this process, or in a process of
    its own behind zenoh, which ends with `close`. With `remember` it is asked only after histories
    in which it has not answered before: then its answers have to follow from task and percepts, and
    its seed is 0 in each game. Or `robot` is a table robot, which knows the true state, and neither
    reasons nor remembers: "cheapest", or a `testbed.learning.Table`. The robot's answer is in what
    the adversary sees. Configuration and options are those of `office_v0.env`.

    Raises:
        ConfigError: for a bad configuration, for one of the fine resolution, and for a robot that
            there is not.
        RobotLost: by `reset` and `step`, where the robot fails, or its table lacks the state.
        UnlikeError: by these, where a remembered robot answers otherwise than before.
    """

    agent = ADVERSARY

    def __init__(
        self,
        config: Config = None,
        robot: str | Table = "intentional",
        link: Link = "inprocess",
        remember: bool = False,
        scenario: str | None = None,
        observations: Form = "dict",
        render_mode: str | None = None,
        **options: Any,
    ) -> None:
        by_table = is_table(robot)
        name = "table" if by_table else str(robot)
        super().__init__(config, name, scenario, observations, render_mode, **options)
        self._table = table_of(robot, self.game.core) if by_table else None
        check_choice("link", link, ("inprocess",) if by_table else get_args(Link))
        if self._table is None:
            check_robot(self.config, robot)
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

    def __getstate__(self) -> dict[str, Any]:
        """The mind of a robot cannot be copied: a copy has another robot, and no game yet."""
        return {**vars(self), "_client": None, "_memory": None, "_open": ExitStack()}

    def __setstate__(self, state: dict[str, Any]) -> None:
        vars(self).update(state)
        if self._table is None:
            self.game.agents = []

    def _begin(self, spec: TrialSpec) -> None:
        if self._table is None:
            self._tell(spec)
        self._let_robot_answer()

    def _tell(self, spec: TrialSpec) -> None:
        """Tell a robot that reasons of the game."""
        if self._client is None:
            seconds = self.config.limits.answer_s
            link = connect(self._link, make_robot, self.config.name, seconds)
            self._client = self._open.enter_context(link)
            self._memory = Remembered(self._client) if self._remembers else None
        seed = 0 if self._remembers else spec.seed
        task = self._setup.task(spec, self.game.core.situation.state, seed)
        (self._memory or self._client).begin(task)

    def _play(self, action: int) -> None:
        self.game.step(action)
        if not self._is_over:
            self._let_robot_answer()

    def _let_robot_answer(self) -> None:
        core = self.game.core
        if self._table is None:
            self.game.step(self._asked())
        else:
            self.game.step(self._table[core.situation.state])

    def _asked(self) -> int:
        """The number of the answer of a robot that reasons."""
        core, memory, client = self.game.core, self._memory, self._client
        assert client is not None
        percept = core.percept
        answer = memory.answer(percept) if memory else client.ask(percept).action
        if answer not in core.robot_actions:
            raise RobotLost(f"answered '{answer}', which is not an action")
        return core.robot_actions.index(answer)


class RobotEnv(Side):
    """The robot's side of games against an adversary: `gymnasium.make("testbed/Robot-v0")`.

    The adversary is that of the configuration: its script, `adversary.strategy`, or the triggers of
    the scenario. Configuration and options are those of `office_v0.env`.

    Raises:
        ConfigError: for a bad configuration, for one of the fine resolution, and for an adversary
            that cannot be made.
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
        check_adversary(self.config, lambda: self._setup.adversary(self._trial))

    def _begin(self, spec: TrialSpec) -> None:
        self._adversary = self._setup.adversary(spec)
        self._adversary.reset(spec.seed)

    def _play(self, action: int) -> None:
        assert self._adversary is not None
        core, sees = self.game.core, self._adversary.sees
        self.game.step(action)
        if self._is_over:  # by an illegal answer
            return
        chosen = self.game._chosen
        assert chosen is not None
        decision = Decision(
            trial=core.situation.trial,
            step=core.situation.step,
            action=chosen,
            believes_goal=False,
            trace=Trace(),
        )
        event = self._adversary.act(adversary_view(core, decision, sees))
        known = event in core.adversary_actions
        why = core.why_not(decision.action, event) if known else "it is not an exogenous action"
        if why is not None:
            raise AdversaryError(f"{event} beside {decision.action}: {why}")
        self.game.step(core.adversary_actions.index(event))
