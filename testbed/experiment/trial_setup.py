"""The setup of trials in a domain: worlds, games, adversaries and tasks, reused across trials."""

from functools import lru_cache, partial
from math import inf
from typing import Any

import msgspec

from agents.adversary import Adversary, Game, Measure, Rehearsal
from asp.language import Fluent, Literal
from asp.refinement import Refinement
from testbed.config import refinement_of_files, refinement_of_size
from testbed.environment import Core, Rules, fine_core
from testbed.experiment.adversaries import make_adversary
from testbed.experiment.judge import Judge
from testbed.experiment.specs import BUDGETS, Setting, TrialSpec, event_rules
from testbed.experiment.storyteller import Storyteller
from testbed.experiment.texts import sha256
from testbed.protocol import Task
from testbed.search import as_it_is, coarse_problem
from testbed.world import World, load_world, world_of


class TrialSetup:
    """The setup of trials in a domain as it is described; it is reused across them.

    `world` is what is played in. `costs` are the execution units of the actions that a record
    counts, and `judge` knows the fewest of them, and of their units. `hashes` are those of the
    domain and of its refinement.
    """

    def __init__(self, world: World) -> None:
        self.costs = world.description.costs
        self.judge = Judge(partial(as_it_is, world), self.costs)
        self._world, self._source = world, world.description.source
        self.hashes: tuple[str, str | None] = sha256(self._source), None
        self.world, self._exogenous = world, world.exogenous_actions

    @property
    def robot(self) -> str:
        """The constant that is the robot."""
        return self._world.description.robots[0]

    def __reduce__(self) -> tuple[Any, ...]:
        """A copy begins without what is remembered."""
        return type(self), (self._world,)

    def core(self, setting: Setting) -> Core:
        """A new game."""
        return Core(self._world, _rules(setting), ())

    def teller(self, trial: str) -> Storyteller:
        """Makes the story of a trial."""
        return Storyteller(trial, self._world)

    def adversary(self, spec: TrialSpec, rehearsal: Rehearsal | None = None) -> Adversary:
        """The script, or the strategy that the setting has; some need a `rehearsal`."""
        rules = event_rules(spec.setting)
        game = Game(
            scenario=spec.scenario,
            goal=spec.setting.goal,
            exogenous_actions=tuple(filter(rules.permits, self._exogenous)),
            description=self._world.description,
            rules=rules,
            world=self.world,
            remaining=partial(self._remaining, spec.setting),
            rehearsal=rehearsal,
        )
        return make_adversary(spec.setting, game)

    def _remaining(self, setting: Setting, state: int, measure: Measure) -> float | None:
        """What a state is away from the goal; see `agents.adversary.Remaining`."""
        least = self.judge.minimal(state, setting.goal, setting.judge_states)
        if least.reason == "no plan":
            return inf
        return least.actions if measure == "actions" else least.units

    def task(self, spec: TrialSpec, state: int, seed: int) -> Task:
        """What the robot is told of a trial that begins in `state`."""
        setting, world = spec.setting, self._world
        complete = setting.knowledge == "complete"
        return Task(
            trial=spec.trial,
            robot=spec.robot,
            domain=spec.domain,
            source=self._source,
            goal=[*map(Literal.parse, setting.goal)],
            initial=list(world.literals(state) if complete else world.visible(state, self.robot)),
            plan_limit=setting.plan_limit,
            relevance=setting.relevance,
            seed=seed,
            plans=setting.plans,
            ties=setting.ties,
            **{name: getattr(setting, name) for name in BUDGETS},
        )


class FineTrialSetup(TrialSetup):
    """The setup in a refined domain: the game is of cells and parts, costs and goals are coarse."""

    def __init__(self, refinement: Refinement) -> None:
        description, coarse = refinement.description, refinement.coarse
        super().__init__(world_of(description))
        self._refinement, self._source = refinement, coarse.text
        self.hashes = sha256(coarse.text), sha256(refinement.text)
        self._fine = self.world = world_of(refinement)
        self._exogenous = self._fine.exogenous_actions
        self.judge = Judge(partial(coarse_problem, refinement), self.costs)
        inertial = self._fine.description.inertial
        self._about_robot = [fluent for fluent in inertial if self.robot in fluent.arguments]

    def __reduce__(self) -> tuple[Any, ...]:
        return type(self), (self._refinement,)

    def core(self, setting: Setting) -> Core:
        """A new game, with the setting's statistics and pace."""
        assert setting.fine is not None
        statistics, pace = setting.fine.statistics, setting.fine.pace
        return fine_core(self._refinement, _rules(setting), statistics, pace=pace)

    def teller(self, trial: str) -> Storyteller:
        """Its story is of both resolutions."""
        return Storyteller(trial, self._fine, frozenset(self._world.fluents))

    def task(self, spec: TrialSpec, state: int, seed: int) -> Task:
        """As of the coarse state, and of the fine one the inertial literals about the robot."""
        true = frozenset(self._fine.true_atoms(state))
        own = [fluent if fluent in true else fluent.complement for fluent in self._about_robot]
        task = super().task(spec, self._world.state(self._coarse_atoms(state)), seed)
        return msgspec.structs.replace(task, refinement=self._refinement.text, initial_fine=own)

    def _coarse_atoms(self, state: int) -> frozenset[Fluent]:
        return frozenset(self._fine.true_atoms(state)).intersection(self._world.fluents)


def setup_of(setting: Setting) -> TrialSetup:
    """The setup of a setting; its world is loaded once. Raises what `asp.load_description` does."""
    return _coarse(setting.domain) if setting.fine is None else _fine(refinement_of(setting))


def refinement_of(setting: Setting) -> Refinement:
    """The descriptions of a setting of the fine resolution. Raises SourceError and OSError."""
    assert setting.fine is not None
    if setting.fine.size is not None:
        return refinement_of_size(setting.fine.size)
    return refinement_of_files(setting.domain, setting.fine.refinement or "")


def _rules(setting: Setting) -> Rules:
    return Rules(
        goal=setting.goal,
        steps=setting.step_limit,
        observability=setting.observability,
        goal_feedback=setting.goal_feedback,
        exogenous_while_thinking=setting.exogenous_while_thinking,
        adversary=event_rules(setting),
        search_states=setting.judge_states,
    )


_coarse = lru_cache(maxsize=8)(lambda domain: TrialSetup(load_world(domain)))
_fine = lru_cache(maxsize=16)(FineTrialSetup)
