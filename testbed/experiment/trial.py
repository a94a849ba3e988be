"""A trial: its world, adversary and robot are set up, and it is played; its record comes out."""

import time
import traceback
from collections.abc import Sequence
from functools import lru_cache, partial
from math import inf

import msgspec

from agents.adversary import Adversary, AdversaryView, Game, Measure, Script, Sight
from asp.language import Fluent, Literal
from asp.refinement import Refinement
from testbed.config import refinement_of_files, refinement_of_size
from testbed.environment import Core, IllegalActionError, Rules, fine_core
from testbed.experiment.adversaries import make_adversary
from testbed.experiment.judge import Judge
from testbed.experiment.origin import load, sha256
from testbed.experiment.record import Occurrence, Rejected
from testbed.experiment.recorder import Recorder, Result
from testbed.experiment.seeds import seeds_within
from testbed.experiment.specs import BUDGETS, Setting, TrialSpec, event_rules
from testbed.experiment.store import check
from testbed.experiment.storyteller import Moment, Storyteller, Watch
from testbed.protocol import (
    NONE,
    NOT_UNDERSTOOD,
    Decision,
    RobotClient,
    RobotGone,
    RobotLost,
    RobotStopped,
    Task,
    Trace,
    in_one_line,
    shortened,
)
from testbed.search import as_it_is, coarse_problem
from testbed.text import listed
from testbed.world import World, load_world, world_of

MOST_DETAILS = 100_000
"""Characters of what is known of a failure; of more the end is kept."""
NO_MIND = Trace()
"""The trace of a robot that tells nothing of its mind."""


def play_trial(spec: TrialSpec, client: RobotClient, watch: Watch = lambda _: None) -> Result:
    """The result of a trial. A lost robot and any error end in the record, never in a raise."""
    recorder = Recorder(spec)
    origin = recorder.origin
    started = time.perf_counter()
    details: str | None = None
    try:
        _play(spec, client, recorder, watch)
    except RobotStopped as stop:
        recorder.fail("error", stop.reason, "robot")
    except RobotLost as loss:
        gone = isinstance(loss, RobotGone)
        recorder.fail("robot_lost", loss.reason, "infrastructure" if gone else "robot")
        details = loss.details or None
    except IllegalActionError as error:
        recorder.fail("error", str(error), "testbed")
    except Exception as error:  # whatever it is, it is this trial's outcome and not the run's
        recorder.fail("error", in_one_line(error), "testbed")
        details = traceback.format_exc()
    try:
        check(recorder.record)
    except msgspec.ValidationError as error:  # one that cannot be written says this, and no more
        recorder = Recorder(spec)
        recorder.fail("robot_lost", f"{NOT_UNDERSTOOD}: {error}", "robot")
    recorder.record.wall_time_s = time.perf_counter() - started
    recorder.record.origin = msgspec.structs.replace(origin, load=load())
    return recorder.result(details and details[-MOST_DETAILS:])


def _play(spec: TrialSpec, client: RobotClient, recorder: Recorder, watch: Watch) -> None:
    setup, goal, record = setup_of(spec.setting), spec.setting.goal, recorder.record
    for_world, for_adversary, for_robot = seeds_within(spec.seed)
    recorder.costs, core = setup.costs, setup.core(spec.setting)
    recorder.origin.domain_sha256, recorder.origin.refinement_sha256 = setup.hashes
    core.reset(seed=for_world, initial=spec.initial, trial=spec.trial)
    least = partial(setup.judge.minimal, core.situation.state, goal, spec.setting.judge_states)
    recorder.teller = setup.teller(spec.trial)
    adversary = setup.adversary(spec)
    adversary.reset(for_adversary)
    try:
        client.begin(setup.task(spec, core.situation.state, for_robot))
        while core.situation.ending is None:
            moment = _step(core, client, adversary, recorder)
            recorder.teller.tell(moment)
            watch(moment)
    except RobotGone:
        raise
    except RobotLost:  # its own error: the trial counts if the goal has a plan
        record.minimal_actions, record.minimal_units, record.minimal_reason = least()
        raise
    finally:
        record.achieved = core.achieved
    record.minimal_actions, record.minimal_units, record.minimal_reason = least()
    recorder.end(core.situation.ending)
    if not core.achieved:
        state = core.situation.state
        record.in_reach = setup.judge.in_reach(state, goal, spec.setting.judge_states)
    if isinstance(adversary, Script) and (left := adversary.unreached(core.situation.step)):
        record.reason = f"script {listed(left)} {'were' if len(left) > 1 else 'was'} not reached"


def _step(core: Core, client: RobotClient, adversary: Adversary, recorder: Recorder) -> Moment:
    before, percept, record = core.situation, core.percept, recorder.record
    decision = client.ask(percept)
    if decision.action not in core.robot_actions:
        raise RobotLost(f"answered '{decision.action}', which is not an action")
    event = adversary.act(_view(core, decision, adversary.sees))
    skipped = adversary.skipped if isinstance(adversary, Script) else ()
    for impossible in skipped:
        why = core.why_not(decision.action, impossible) or f"beside {event}"
        record.rejected.append(Rejected(before.step, impossible, shortened(why)))
    core.advance(decision.action, event)
    after = core.situation
    recorder.step(decision, after.happened)
    exogenous = None if event == NONE else event
    if exogenous is not None:
        record.exogenous.append(Occurrence(before.step, exogenous, observed=False))
    for report in after.told:
        recorder.report(after.step, report)
    return Moment(percept, decision, after.happened, exogenous, before.state, after.state, skipped)


def _view(core: Core, decision: Decision, sees: Sequence[Sight]) -> AdversaryView:
    now, sees_action, robot_action = core.situation, "robot_action" in sees, decision.action
    is_told = "trace" in sees and decision.trace != NO_MIND
    return AdversaryView(
        step=now.step,
        state=frozenset(core.world.true_atoms(now.state) if "state" in sees else ()),
        robot_action=robot_action if sees_action else None,
        legal=core.legal_events(robot_action),
        physical=sees_action and core.is_physical(robot_action),
        left=core.left,
        trace=decision.trace if is_told else None,
    )


class TrialSetup:
    """The setup of trials in a domain as it is described; it is reused across them.

    `costs` are the execution units of the actions that a record counts, and `judge` knows the
    fewest of them, and of their units. `hashes` are those of the domain and of its refinement.
    """

    def __init__(self, world: World) -> None:
        self.costs = world.description.costs
        self.judge = Judge(partial(as_it_is, world), self.costs)
        self._world, self._source = world, world.description.source
        self.hashes: tuple[str, str | None] = sha256(self._source), None
        self._played, self._exogenous = world, world.exogenous_actions

    def core(self, setting: Setting) -> Core:
        """A new game."""
        return Core(self._world, _rules(setting), ())

    def teller(self, trial: str) -> Storyteller:
        """Makes the story of a trial."""
        return Storyteller(trial, self._world)

    def adversary(self, spec: TrialSpec) -> Adversary:
        """The script, or the strategy that the setting has."""
        rules = event_rules(spec.setting)
        game = Game(
            scenario=spec.scenario,
            goal=spec.setting.goal,
            exogenous_actions=tuple(filter(rules.permits, self._exogenous)),
            description=self._world.description,
            rules=rules,
            world=self._played,
            remaining=partial(self._remaining, spec.setting),
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
        robot = world.description.robots[0]
        return Task(
            trial=spec.trial,
            robot=spec.robot,
            domain=spec.domain,
            source=self._source,
            goal=[*map(Literal.parse, setting.goal)],
            initial=list(world.literals(state) if complete else world.visible(state, robot)),
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
        self._fine = self._played = world_of(refinement)
        self._exogenous = self._fine.exogenous_actions
        self.judge = Judge(partial(coarse_problem, refinement), self.costs)
        inertial, robot = self._fine.description.inertial, description.robots[0]
        self._about_robot = [fluent for fluent in inertial if robot in fluent.arguments]

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
