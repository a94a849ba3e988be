"""The game as a PettingZoo parallel environment: robot and adversary answer at once."""

from collections.abc import Mapping
from typing import Any, TypeAlias

from pettingzoo import ParallelEnv

from asp.language import Action
from testbed.environment.core import Snapshot
from testbed.environment.observation import Observation
from testbed.environment.rules import ADVERSARY, IllegalActionError
from testbed.environment.view import View
from testbed.protocol import NONE

Shown: TypeAlias = tuple[dict[str, Observation], dict[str, dict[str, Any]]]
"""Observations and infos, by agent."""
Flags: TypeAlias = dict[str, bool]
Stepped: TypeAlias = tuple[
    dict[str, Observation], dict[str, float], Flags, Flags, dict[str, dict[str, Any]]
]
"""What `step` returns: observations, rewards, terminations, truncations, infos, by agent."""
ParallelSnapshot: TypeAlias = tuple[Snapshot, tuple[str, ...]]
"""The core's snapshot, and the agents whose last answer was illegal."""


class ParallelView(View, ParallelEnv[str, Observation, int]):
    """A view of a core: one call per step.

    The adversary does not know the robot's answer: its mask holds what is possible by itself, and
    an exogenous action that is not legal beside the robot's is dropped, which
    `infos["adversary_0"]["dropped"]` says. An answer that is no action at all, or none for an
    agent, raises IllegalActionError and changes nothing. By conventions other than `error` an
    answer outside the agent's mask is illegal. Options of `reset` as for the AEC view.
    """

    def reset(self, seed: int | None = None, options: dict[str, Any] | None = None) -> Shown:
        self._begin(seed, options)
        return self._shown(None)

    def step(self, actions: Mapping[str, int]) -> Stepped:
        self._check_begun()
        if not self.agents:
            raise IllegalActionError("the game is over: reset the environment")
        given = {agent: actions.get(agent) for agent in self.agents}
        illegal = tuple(agent for agent, own in given.items() if self._is_illegal(agent, own))
        if illegal and self.conventions.illegal == "terminate":
            return self._stop(illegal)
        robot_action, event = (
            own[0] if agent in illegal else self._named(agent, given[agent])
            for agent, own in self._actions.items()
        )
        self._illegal = illegal
        dropped = None if self.core.legal(robot_action, event) else event
        self.core.advance(robot_action, NONE if dropped else event)
        ended = self.core.situation.ending
        if ended is not None:
            self.agents = []
        observations, information = self._shown(dropped)
        return observations, self.core.rewards, *self._ends(ended), information

    def _is_illegal(self, agent: str, answer: Any) -> bool:
        """Whether an answer lies outside the mask, which conventions have to tolerate."""
        if not self._tolerates(agent, answer):
            return False
        own = self._actions[agent]
        outside = int(answer) >= len(own)
        return outside or (agent == ADVERSARY and not self.core.legal(None, own[int(answer)]))

    def _stop(self, illegal: tuple[str, ...]) -> Stepped:
        """End the game by the illegal answer of the first of these agents."""
        self._illegal = illegal
        both, self.agents = list(self.agents), []
        earned = self.core.rewards_of_illegal(illegal[0])
        observations, information = self._shown(None)
        ended = dict.fromkeys(both, True)
        return observations, earned, ended, dict(ended), information

    def _shown(self, dropped: Action | None) -> Shown:
        information = self._infos(None)
        number = -1 if dropped is None else self.core.adversary_actions.index(dropped)
        text = self.conventions.infos == "text"
        information[ADVERSARY]["dropped"] = dropped if text else number
        return {agent: self._observed(agent, None) for agent in self.possible_agents}, information

    def snapshot(self) -> ParallelSnapshot:
        """All that the rest of the episode depends on."""
        return self.core.snapshot(), self._illegal

    def restore(self, snapshot: ParallelSnapshot) -> Shown:
        """Goes back to the snapshot, which may be used again; returns what `reset` would."""
        core, self._illegal = snapshot
        self.core.restore(core)
        is_over = self.core.situation.ending is not None or self._is_stopped
        self.agents = [] if is_over else list(self.possible_agents)
        return self._shown(None)
