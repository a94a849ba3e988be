"""The game as a PettingZoo parallel environment: robot and adversary answer at once."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, TypeAlias

from pettingzoo import ParallelEnv

from testbed.environment.legality import NONE
from testbed.environment.observation import Observation, infos, observe
from testbed.environment.rules import (
    ADVERSARY,
    ROBOT,
    IllegalActionError,
    Snapshot,
    name_of,
    rewards,
)
from testbed.environment.view import View

Observations: TypeAlias = dict[str, Observation]
Flags: TypeAlias = dict[str, bool]
Infos: TypeAlias = dict[str, dict[str, Any]]
Transition: TypeAlias = tuple[Observations, dict[str, float], Flags, Flags, Infos]


class ParallelView(View, ParallelEnv[str, Observation, int]):
    """A view of a core: one call a step.

    The adversary does not know the robot's answer: its mask holds what is possible by itself, and
    an exogenous action that is impossible beside the robot's is dropped, which
    `infos["adversary_0"]["dropped"]` says. An answer that is no action at all, or none for an
    agent, raises IllegalActionError and changes nothing. Options of `reset` as for the AEC view.
    """

    def reset(
        self, seed: int | None = None, options: dict[str, Any] | None = None
    ) -> tuple[Observations, Infos]:
        self._begin(seed, options)
        return self._observations(), self._infos(None)

    def step(self, actions: Mapping[str, int]) -> Transition:
        self._check_begun()
        if not self.agents:
            raise IllegalActionError("the game is over: reset the environment")
        robot_action = name_of(ROBOT, actions.get(ROBOT), self.core.robot_actions)
        event = name_of(ADVERSARY, actions.get(ADVERSARY), self.core.adversary_actions)
        dropped = None if self.core.legal(robot_action, event) else event
        self.core.advance(robot_action, NONE if dropped else event)
        ending = self.core.situation.ending
        if ending is not None:
            self.agents = []
        return self._observations(), rewards(ending), *self._ends(), self._infos(dropped)

    def _observations(self) -> Observations:
        return {agent: observe(self.core, agent, None) for agent in self.possible_agents}

    def _infos(self, dropped: str | None) -> Infos:
        information = infos(self.core, None)
        information[ADVERSARY]["dropped"] = dropped
        return information

    def snapshot(self) -> Snapshot:
        """All that the rest of the episode depends on."""
        return self.core.snapshot()

    def restore(self, snapshot: Snapshot) -> tuple[Observations, Infos]:
        """Goes back to the snapshot, which may be used again; returns what `reset` would."""
        self.core.restore(snapshot)
        self.agents = list(self.possible_agents) if snapshot.situation.ending is None else []
        return self._observations(), self._infos(None)
