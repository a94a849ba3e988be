"""Where a trial is played: its world, the game in it, and what the robot is told at the start."""

from __future__ import annotations

from collections.abc import Mapping
from functools import lru_cache
from typing import Protocol

from agents.adversary import Adversary, Game
from testbed.config import Ground, ground_of_files, ground_of_size
from testbed.environment import Core
from testbed.experiment.adversaries import make_adversary
from testbed.experiment.domains import load_world
from testbed.experiment.fine_trial_setup import FineStage, fine_part
from testbed.experiment.game_rules import known, rules_of
from testbed.experiment.judge import Judge
from testbed.experiment.oracle import minimal_actions, minimal_units
from testbed.experiment.specs import Setting, TrialSpec
from testbed.protocol import Task
from testbed.world import World


class Stage(Protocol):
    """The place of a setting's trials at one resolution; it lives across them."""

    @property
    def costs(self) -> Mapping[str, int]:
        """Execution units of the actions that a record counts."""

    @property
    def judge(self) -> Judge:
        """Who knows the least number of recorded actions, and of their units."""

    def core(self, setting: Setting) -> Core:
        """A new game."""

    def adversary(self, spec: TrialSpec) -> Adversary:
        """Who plays against the robot."""

    def task(self, spec: TrialSpec, state: int, seed: int) -> Task:
        """What the robot is told of a trial that begins in `state`."""


class CoarseStage:
    """A domain as it is described."""

    def __init__(self, world: World) -> None:
        self._world = world
        costs = self.costs = world.description.costs
        self.judge = Judge(
            lambda state, goal, most: minimal_actions(world, state, goal, most),
            lambda state, goal, most: minimal_units(world, state, goal, costs, most),
        )

    def core(self, setting: Setting) -> Core:
        """A new game."""
        return Core(self._world, rules_of(setting), ())

    def adversary(self, spec: TrialSpec) -> Adversary:
        """The script, or the strategy that the setting has."""
        description = self._world.description
        game = Game(
            scenario=spec.scenario,
            goal=spec.setting.goal,
            exogenous_actions=description.exogenous_actions,
            description=description,
        )
        return make_adversary(spec.setting, game)

    def task(self, spec: TrialSpec, state: int, seed: int) -> Task:
        """Of the initial state the robot is told what the setting says that it knows."""
        return Task(
            trial=spec.trial,
            robot=spec.robot,
            domain=spec.domain,
            source=self._world.description.source,
            goal=list(spec.setting.goal),
            initial=list(known(spec.setting, self._world, state)),
            plan_limit=spec.setting.plan_limit,
            seed=seed,
            decision_s=spec.setting.decision_s,
            conflicts=spec.setting.conflicts,
            ground_rules=spec.setting.ground_rules,
            expansions=spec.setting.expansions,
        )


def load_stage(setting: Setting) -> Stage:
    """The stage of a setting; its world is loaded once. Raises what `asp.load_description` does."""
    if setting.fine is None:
        return _coarse_stage(setting.domain)
    return _fine_stage(load_ground(setting))


def load_ground(setting: Setting) -> Ground:
    """The descriptions of a setting of the fine resolution. Raises SourceError and OSError."""
    fine = fine_part(setting)
    if fine.size is not None:
        return ground_of_size(fine.size)
    return ground_of_files(setting.domain, fine.refinement or "")


@lru_cache(maxsize=8)
def _coarse_stage(domain: str) -> CoarseStage:
    return CoarseStage(load_world(domain))


@lru_cache(maxsize=16)
def _fine_stage(ground: Ground) -> FineStage:
    return FineStage(ground)
