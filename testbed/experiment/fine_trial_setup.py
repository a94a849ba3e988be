"""Where a trial is played at the fine resolution."""

from __future__ import annotations

from agents.adversary import Adversary, Game
from asp.language import arguments, complement
from testbed.config import Ground
from testbed.environment import Core, fine_core
from testbed.experiment.adversaries import make_adversary
from testbed.experiment.game_rules import known, rules_of
from testbed.experiment.judge import Judge
from testbed.experiment.oracle import Oracle
from testbed.experiment.specs import FineSetting, Setting, TrialSpec
from testbed.protocol import Task
from testbed.world import world_of


class FineStage:
    """A refined domain: the game is played in cells and parts, costs and goals are coarse."""

    def __init__(self, ground: Ground) -> None:
        refinement = ground.refinement
        description = refinement.description
        self._refinement, self._text = refinement, ground.text
        self._world = world_of(refinement)
        self._coarse = world_of(description)
        oracle = Oracle(description, refinement.coarse, refinement.coarse_signature)
        atoms, costs = self._coarse_atoms, description.costs
        self.costs = costs
        self.judge = Judge(
            lambda state, goal, most: oracle.minimal_actions(atoms(state), goal, most),
            lambda state, goal, most: oracle.minimal_units(atoms(state), goal, costs, most),
        )
        inertial, robot = self._world.description.inertial, description.robots[0]
        self._about_robot = [fluent for fluent in inertial if robot in arguments(fluent)]

    def core(self, setting: Setting) -> Core:
        """A new game, with the setting's statistics and pace."""
        fine = fine_part(setting)
        return fine_core(self._refinement, rules_of(setting), fine.statistics, pace=fine.pace)

    def adversary(self, spec: TrialSpec) -> Adversary:
        """The script, or the strategy that the setting has."""
        game = Game(
            scenario=spec.scenario,
            goal=spec.setting.goal,
            exogenous_actions=self._world.exogenous_actions,
            description=self._refinement.description,
        )
        return make_adversary(spec.setting, game)

    def task(self, spec: TrialSpec, state: int, seed: int) -> Task:
        """Of the fine initial state the robot is told what holds of itself."""
        return Task(
            trial=spec.trial,
            robot=spec.robot,
            domain=spec.domain,
            source=self._refinement.coarse.text,
            goal=list(spec.setting.goal),
            initial=list(known(spec.setting, self._coarse, self._coarse_state(state))),
            plan_limit=spec.setting.plan_limit,
            seed=seed,
            decision_s=spec.setting.decision_s,
            conflicts=spec.setting.conflicts,
            ground_rules=spec.setting.ground_rules,
            expansions=spec.setting.expansions,
            refinement=self._text,
            initial_fine=self._own(state),
        )

    def _own(self, state: int) -> list[str]:
        """The inertial literals about the robot: where it is and is not, what it holds and not."""
        true = frozenset(self._world.true_atoms(state))
        return [fluent if fluent in true else complement(fluent) for fluent in self._about_robot]

    def _coarse_atoms(self, state: int) -> frozenset[str]:
        return frozenset(self._world.true_atoms(state)).intersection(self._coarse.fluents)

    def _coarse_state(self, state: int) -> int:
        return self._coarse.state(self._coarse_atoms(state))


def fine_part(setting: Setting) -> FineSetting:
    """What a setting says of the fine resolution, which it has to."""
    if setting.fine is None:
        raise ValueError("this is a setting of the coarse resolution")
    return setting.fine
