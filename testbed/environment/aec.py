"""The game as a PettingZoo AEC environment: the robot answers, then the adversary beside it."""

from copy import deepcopy
from typing import Any, TypeAlias

from pettingzoo import AECEnv
from pettingzoo.utils.wrappers import OrderEnforcingWrapper

from asp.language import Action
from testbed.environment.conventions import ILLEGAL_REWARD
from testbed.environment.core import Snapshot
from testbed.environment.observation import Observation
from testbed.environment.rules import ADVERSARY, ROBOT, IllegalActionError, known_agent, listed
from testbed.environment.view import View

_TOLD = ("rewards", "_cumulative_rewards", "terminations", "truncations", "infos")
"""The attributes in which PettingZoo tells the agents of a step."""
_TURN = ("agents", "agent_selection", "_chosen", "_illegal", *_TOLD)
"""With these, the attributes that belong to the turn."""


AECSnapshot: TypeAlias = tuple[Snapshot, dict[str, Any]]
"""The core's snapshot, and whose turn it is with what PettingZoo has told so far."""


class AECView(View, AECEnv[str, Observation, int | None]):
    """A view of a core: two answers a step, the second of which plays it.

    An answer outside the mask raises IllegalActionError and changes nothing, unless conventions say
    otherwise. `reset` takes the
    options `initial` (literals: begin there, raises StateError) and `trial` (an id for percepts),
    and raises UnknownOptionError for others. Before it, what needs a game raises NotResetError.
    """

    _chosen: Action | None = None
    """The robot's answer, until the adversary has given its own."""

    def reset(self, seed: int | None = None, options: dict[str, Any] | None = None) -> None:
        self._begin(seed, options)
        self._cumulative_rewards = dict.fromkeys(self.agents, 0.0)
        self._open_turn()

    def last(
        self, observe: bool = True
    ) -> tuple[Observation | None, float, bool, bool, dict[str, Any]]:
        self._check_begun()
        return super().last(observe)

    def step(self, action: int | None) -> None:
        self._check_begun()
        agent = self.agent_selection
        if self.terminations[agent] or self.truncations[agent]:
            self._was_dead_step(action)
            return
        try:
            self._answer(agent, action)
        except IllegalActionError:
            if not self._tolerates(agent, action):
                raise
            self._answer_illegally(agent)

    def _answer(self, agent: str, action: int | None) -> None:
        answer = self._named(agent, action)
        (self._robot_answers if agent == ROBOT else self._adversary_answers)(answer)

    def _answer_illegally(self, agent: str) -> None:
        """Let the agent do nothing, or end the game, as PettingZoo's TerminateIllegalWrapper."""
        if self.conventions.illegal == "noop":
            self._answer(agent, 0)
            self.infos[agent]["illegal"] = 1
            return
        self._illegal = agent
        self._cumulative_rewards[agent] = 0.0
        self.terminations = dict.fromkeys(self.agents, True)
        self.truncations = dict.fromkeys(self.agents, True)
        self.rewards = {**dict.fromkeys(self.agents, 0.0), agent: ILLEGAL_REWARD}
        self._accumulate_rewards()
        self._deads_step_first()

    def _robot_answers(self, action: Action) -> None:
        self._cumulative_rewards[ROBOT] = 0.0
        self._clear_rewards()
        self._chosen = action
        self.agent_selection = ADVERSARY
        self.infos = self._infos(action)

    def _adversary_answers(self, event: Action) -> None:
        assert self._chosen is not None
        reason = self.core.why_not(self._chosen, event)
        if reason is not None:
            actions, legal = self.core.adversary_actions, self.core.events(self._chosen)
            raise IllegalActionError(
                f"{ADVERSARY}: {actions.index(event)} {event} is not legal: {reason}; "
                f"legal are {listed(actions, legal)}"
            )
        self.core.advance(self._chosen, event)
        self._cumulative_rewards[ADVERSARY] = 0.0
        self._open_turn()
        self._accumulate_rewards()
        self._deads_step_first()

    def _open_turn(self) -> None:
        """The robot is next, and both agents are told of the new situation."""
        self._chosen = None
        self.agent_selection = ROBOT
        self.terminations, self.truncations = self._ends()
        self.rewards = self.core.rewards
        self.infos = self._infos(None)

    def observe(self, agent: str) -> Observation:
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
