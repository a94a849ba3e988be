"""The game as a PettingZoo AEC environment: the robot answers, then the adversary beside it."""

from copy import deepcopy
from typing import Any, TypeAlias

import numpy as np
from pettingzoo import AECEnv
from pettingzoo.utils.wrappers import OrderEnforcingWrapper

from asp.language import Action
from testbed.environment.conventions import Conventions
from testbed.environment.core import Core, Snapshot
from testbed.environment.observation import Observation
from testbed.environment.rules import (
    ADVERSARY,
    ROBOT,
    Ending,
    IllegalActionError,
    NotResetError,
    known_agent,
    listed,
    rewards,
)
from testbed.environment.tabled import TabledGame, has_tables
from testbed.environment.view import DEFAULT, View

_TOLD = ("rewards", "_cumulative_rewards", "terminations", "truncations", "infos")
"""The attributes in which PettingZoo tells the agents of a step."""
_TURN = ("agents", "agent_selection", "_answered", "_illegal", *_TOLD)
"""With these, the attributes that belong to the turn."""


INTEGERS = (int, np.int64, np.int32)
"""Types of answers that the tables take; others are looked at one by one."""

AECSnapshot: TypeAlias = tuple[Snapshot, dict[str, Any]]
"""The core's snapshot, and whose turn it is with what PettingZoo has told so far."""


class AECView(View, AECEnv[str, Observation, int | None]):
    """A view of a core: two answers a step, the second of which plays it.

    An answer outside the mask raises IllegalActionError and changes nothing, unless conventions say
    otherwise. `reset` takes the options `initial` (literals: begin there, raises StateError) and
    `trial` (an id for percepts), and raises ResetOptionError for what these cannot be, and for
    others. Before it, what needs a game raises NotResetError.
    """

    _answered: int | None = None
    """The number of the robot's answer, until the adversary has given its own."""
    _told: dict[str, dict[str, Any]]
    """The infos of this turn; those that are missing are as the tables say."""

    def __init__(
        self, core: Core, render_mode: str | None = None, conventions: Conventions = DEFAULT
    ) -> None:
        super().__init__(core, render_mode, conventions)
        is_plain = conventions.infos == "numeric" and not conventions.padded
        self._tabled = TabledGame(core) if is_plain and has_tables(core) else None

    @property
    def _chosen(self) -> Action | None:
        return None if self._answered is None else self._actions[ROBOT][self._answered]

    @property
    def infos(self) -> dict[str, dict[str, Any]]:
        """What each agent is told beside its observation."""
        for agent in self.agents:
            self._info(agent)
        return self._told

    @infos.setter
    def infos(self, told: dict[str, dict[str, Any]]) -> None:
        self._told = told

    def _info(self, agent: str) -> dict[str, Any]:
        """What one agent is told; the same object whenever it is asked for in a turn."""
        told = self._told.get(agent)
        if told is None:
            assert self._tabled is not None
            told = self._told[agent] = self._tabled.info(agent, self._answered)
            if self._illegal:
                told["illegal"] = int(agent in self._illegal)
        return told

    def reset(self, seed: int | None = None, options: dict[str, Any] | None = None) -> None:
        self._begin(seed, options)
        self._cumulative_rewards = dict.fromkeys(self.agents, 0.0)
        self._open_turn()

    def last(
        self, observe: bool = True
    ) -> tuple[Observation | None, float, bool, bool, dict[str, Any]]:
        if self.core.now is None:
            raise NotResetError
        agent, seen = self.agent_selection, None
        if observe:
            game = None if self._illegal else self._tabled
            seen = None if game is None else game.observe(agent, self._answered)
            seen = self.observe(agent) if seen is None else seen
        told = self._told.get(agent) or self._info(agent)
        earned = self._cumulative_rewards[agent]
        return seen, earned, self.terminations[agent], self.truncations[agent], told

    def step(self, action: int | None) -> None:
        if type(action) in INTEGERS and self._steps_in_tables(int(action)):  # type: ignore[arg-type]
            return
        self._check_begun()
        agent = self.agent_selection
        if self.terminations[agent] or self.truncations[agent]:
            self._was_dead_step(action)
            return
        try:
            answer = self._legal(agent, action)
            self._illegal = tuple(own for own in self._illegal if own != agent)
        except IllegalActionError:
            if not self._tolerates(agent, action):
                raise
            self._illegal = tuple(own for own in self.agents if own in (agent, *self._illegal))
            if self._is_stopped:
                self._stop(agent)
                return
            answer = self._actions[agent][0]
        (self._robot_answers if agent == ROBOT else self._adversary_answers)(answer)

    def _steps_in_tables(self, number: int) -> bool:
        """Play an answer by the tables; False: that is not possible, and nothing has changed."""
        game = self._tabled
        if game is None or self._illegal or not game.is_under_way():
            return False
        if self._answered is None:
            if not 0 <= number < game.answers:
                return False
            self._answered, self.agent_selection, self._told = number, ADVERSARY, {}
            return True
        if not 0 <= number < game.events or not game.play(self._answered, number):
            return False
        self._answered, self.agent_selection, self._told = None, ROBOT, {}
        if game.ending is not None:
            self._end(game.ending)
        return True

    def _end(self, ending: Ending) -> None:
        self.terminations, self.truncations = self._ends(ending)
        self.rewards = rewards(ending)
        self._accumulate_rewards()
        self._deads_step_first()

    def _legal(self, agent: str, action: int | None) -> Action:
        """The action of an answer. Raises IllegalActionError."""
        answer = self._named(agent, action)
        if agent == ROBOT:
            return answer
        assert self._chosen is not None
        reason = self.core.why_not(self._chosen, answer)
        if reason is not None:
            actions, legal = self.core.adversary_actions, self.core.events(self._chosen)
            raise IllegalActionError(
                f"{ADVERSARY}: {actions.index(answer)} {answer} is not legal: {reason}; "
                f"legal are {listed(actions, legal)}"
            )
        return answer

    def _stop(self, agent: str) -> None:
        """End the game by the agent's illegal answer, as PettingZoo's TerminateIllegalWrapper."""
        self.infos = self._infos(self._chosen)
        self._cumulative_rewards[agent] = 0.0
        self.terminations = dict.fromkeys(self.agents, True)
        self.truncations = dict.fromkeys(self.agents, True)
        self.rewards = self.core.rewards_of_illegal(agent)
        self._accumulate_rewards()
        self._deads_step_first()

    def _robot_answers(self, action: Action) -> None:
        self._cumulative_rewards[ROBOT] = 0.0
        self._clear_rewards()
        self._answered = self._actions[ROBOT].index(action)
        self.agent_selection = ADVERSARY
        self.infos = self._infos(action)

    def _adversary_answers(self, event: Action) -> None:
        assert self._chosen is not None
        self.core.advance(self._chosen, event)
        self._cumulative_rewards[ADVERSARY] = 0.0
        self._open_turn()
        self._accumulate_rewards()
        self._deads_step_first()

    def _open_turn(self) -> None:
        """The robot is next, and both agents are told of the new situation."""
        self._answered = None
        self.agent_selection = ROBOT
        if self._tabled is not None and self._tabled.is_under_way():
            self.terminations, self.truncations = self._ends(None)
            self.rewards, self._told = rewards(None), {}
            return
        self.terminations, self.truncations = self._ends(self.core.situation.ending)
        self.rewards = self.core.rewards
        self._told = self._infos(None)

    def observe(self, agent: str) -> Observation:
        if self._tabled is not None and not self._illegal:
            seen = self._tabled.observe(agent, self._answered)
            if seen is not None:
                return seen
        return self._observed(known_agent(agent), self._chosen)

    def snapshot(self) -> AECSnapshot:
        """A copy of all that the rest of the episode depends on."""
        return self.core.snapshot(), deepcopy({name: getattr(self, name) for name in _TURN})

    def restore(self, snapshot: AECSnapshot) -> None:
        """Goes back to the snapshot, which may be used again."""
        core, turn = snapshot
        self.core.restore(core)
        for name, value in deepcopy(turn).items():
            setattr(self, name, value)


class OrderedView(OrderEnforcingWrapper[str, Observation, int | None]):
    """PettingZoo's wrapper, which hides what begins with `_`, with the notebook's view shown."""

    def _repr_html_(self) -> str:
        view = self.unwrapped
        assert isinstance(view, AECView)
        return view._repr_html_()
