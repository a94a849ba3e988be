"""A trial: its world, adversary and robot are set up, it is played, and its record comes out."""

import time
import traceback
from collections.abc import Sequence

import msgspec

from agents.adversary import Adversary, AdversaryView, Script, Sight
from testbed.environment import Core, IllegalActionError
from testbed.experiment.episodes import Player
from testbed.experiment.judge import Judge
from testbed.experiment.origin import load
from testbed.experiment.record import Occurrence, Rejected, TrialRecord
from testbed.experiment.recorder import Recorder, Result
from testbed.experiment.seeds import seeds_within
from testbed.experiment.specs import TrialSpec
from testbed.experiment.store import check
from testbed.experiment.storyteller import Moment, Watch
from testbed.experiment.trial_setup import setup_of
from testbed.protocol import (
    NONE,
    NOT_UNDERSTOOD,
    Decision,
    RobotClient,
    RobotGone,
    RobotLost,
    RobotStopped,
    Trace,
    in_one_line,
    shortened,
)
from testbed.text import listed

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
    recorder.teller = setup.teller(spec.trial)
    adversary = setup.adversary(spec, Player(spec))
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
        _judge(record, setup.judge, core)
        raise
    finally:
        record.achieved = core.achieved
    _judge(record, setup.judge, core)
    recorder.end(core.situation.ending)
    if not core.achieved:
        state = core.situation.state
        record.in_reach = setup.judge.in_reach(state, goal, spec.setting.judge_states)
    if isinstance(adversary, Script) and (left := adversary.unreached(core.situation.step)):
        record.reason = f"script {listed(left)} {'were' if len(left) > 1 else 'was'} not reached"


def _judge(record: TrialRecord, judge: Judge, core: Core) -> None:
    """The least that achieves the goal, with and without what happened."""
    now, most = core.situation, core.rules.search_states
    least = judge.minimal(now.start, now.goal, most)
    record.minimal_actions, record.minimal_units, record.minimal_reason = least
    record.oracle_units = judge.knowing(now.start, now.goal, now.played, most)


def _step(core: Core, client: RobotClient, adversary: Adversary, recorder: Recorder) -> Moment:
    before, percept, record = core.situation, core.percept, recorder.record
    decision = client.ask(percept)
    if decision.action not in core.robot_actions:
        raise RobotLost(f"answered '{decision.action}', which is not an action")
    event = adversary.act(adversary_view(core, decision, adversary.sees))
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


def adversary_view(core: Core, decision: Decision, sees: Sequence[Sight]) -> AdversaryView:
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
