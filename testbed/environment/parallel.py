"""The game as a PettingZoo parallel environment: robot and adversary answer at once."""

from collections.abc import Mapping
from typing import Any, TypeAlias

from pettingzoo import ParallelEnv

from testbed.environment.core import Snapshot
from testbed.environment.observation import Observation, View, infos, observe
from testbed.environment.rules import ADVERSARY, ROBOT, IllegalActionError, name_of
from testbed.protocol import NONE

Shown: TypeAlias = tuple[dict[str, Observation], dict[str, dict[str, Any]]]
"""Observations and infos, by agent."""
Flags: TypeAlias = dict[str, bool]


class ParallelView(View, ParallelEnv[str, Observation, int]):
    """A view of a core: one call per step.

    The adversary does not know the robot's answer: its mask holds what is possible by itself, and
    an exogenous action that is not legal beside the robot's is dropped, which
    `infos["adversary_0"]["dropped"]` says. An answer that is no action at all, or none for an
    agent, raises IllegalActionError and changes nothing. Options of `reset` as for the AEC view.
    """

    def reset(self, seed: int | None = None, options: dict[str, Any] | None = None) -> Shown:
        self._begin(seed, options)
        return self._shown(None)

    def step(
        self, actions: Mapping[str, int]
    ) -> tuple[dict[str, Observation], dict[str, float], Flags, Flags, dict[str, dict[str, Any]]]:
        self._check_begun()
        if not self.agents:
            raise IllegalActionError("the game is over: reset the environment")
        robot_action = name_of(ROBOT, actions.get(ROBOT), self.core.robot_actions)
        event = name_of(ADVERSARY, actions.get(ADVERSARY), self.core.adversary_actions)
        dropped = None if self.core.legal(robot_action, event) else event
        self.core.advance(robot_action, NONE if dropped else event)
        if self.core.situation.ending is not None:
            self.agents = []
        observations, information = self._shown(dropped)
        return observations, self.core.rewards, *self._ends(), information

    def _shown(self, dropped: str | None) -> Shown:
        information = infos(self.core, None)
        information[ADVERSARY]["dropped"] = dropped
        return {agent: observe(self.core, agent, None) for agent in (ROBOT, ADVERSARY)}, information

    def snapshot(self) -> Snapshot:
        """All that the rest of the episode depends on."""
        return self.core.snapshot()

    def restore(self, snapshot: Snapshot) -> Shown:
        """Goes back to the snapshot, which may be used again; returns what `reset` would."""
        self.core.restore(snapshot)
        self.agents = list(self.possible_agents) if self.core.situation.ending is None else []
        return self._shown(None)
