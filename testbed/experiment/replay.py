"""Play a stored trial again, in this process, and tell it step by step."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from pathlib import Path

from testbed.config.errors import nearest
from testbed.environment.core import FINISH
from testbed.environment.world import World
from testbed.experiment.domains import load_world
from testbed.experiment.errors import StoreError
from testbed.experiment.plan import TrialSpec, plan_trials
from testbed.experiment.record import TrialRecord, logical
from testbed.experiment.registry import make_robot
from testbed.experiment.store import read_config, read_records
from testbed.experiment.trial import Moment, Result, play_trial
from testbed.link.inprocess import InProcessRobot

Say = Callable[[str], None]


def replay(folder: Path, trial: str, say: Say) -> bool:
    """Tell the trial of a run whose id begins with `trial`; is it as recorded?

    True also where there is no record of it yet.

    Raises:
        StoreError: for a folder without a run, or an id that is not one of its trials.
        ConfigError: where the stored configuration is not valid any more.
    """
    spec = find_trial(plan_trials(read_config(folder)), trial)
    world = load_world(spec.setting.domain)
    say(f"trial {spec.trial}: scenario {spec.scenario}, {spec.robot}, seed {spec.seed}")
    say(f"goal: {' '.join(spec.setting.goal)}")
    result = play_trial(spec, InProcessRobot(make_robot), lambda moment: _tell(moment, world, say))
    _tell_end(result, say)
    return _compare(_recorded(folder, spec), result.record, say)


def find_trial(specs: Iterable[TrialSpec], trial: str) -> TrialSpec:
    """The trial whose id begins with `trial`. Raises StoreError unless there is exactly one."""
    known = list(specs)
    found = [spec for spec in known if trial and spec.trial.startswith(trial)]
    if len(found) == 1:
        return found[0]
    if found:
        ids = ", ".join(spec.trial for spec in found[:5])
        raise StoreError(f"--trial {trial}: several trials begin so: {ids}")
    near = nearest(trial, [spec.trial for spec in known])
    hint = near if near.startswith("did") else f"one of them is {known[0].trial}"
    raise StoreError(f"--trial {trial}: not one of the run's {len(known)} trials; {hint}")


def _tell(moment: Moment, world: World, say: Say) -> None:
    for line in _lines(moment, world):
        say(line)


def _lines(moment: Moment, world: World) -> Iterator[str]:
    trace = moment.decision.trace
    yield ""
    yield f"step {moment.percept.step}"
    truth = sorted(world.true_atoms(moment.before))
    yield f"  world        {' '.join(truth)}"
    if moment.percept.goal_holds is False:
        yield "  told         the goal does not hold"
    if moment.percept.events:
        news = (f"{event.action} at step {event.step}" for event in moment.percept.events)
        yield f"  told         {', '.join(news)}"
    yield f"  belief       {' '.join(sorted(trace.belief)) or '-'}"
    if trace.belief and sorted(trace.belief) != truth:
        yield f"               in truth {_difference(trace.belief, truth)}"
    if trace.explanation is not None:
        yield f"  explanation  {_explanation(moment)}"
    yield f"  intention    {_intention(moment)}"
    yield f"  action       {_action(moment)}"
    if moment.event is not None:
        yield f"  others       {moment.event}"


def _difference(belief: Iterable[str], truth: Iterable[str]) -> str:
    missing, wrong = sorted(set(truth) - set(belief)), sorted(set(belief) - set(truth))
    return " ".join([*missing, *(f"-{atom}" for atom in wrong)])


def _explanation(moment: Moment) -> str:
    explanation = moment.decision.trace.explanation
    assert explanation is not None
    events = [f"{event.action} at step {event.step}" for event in explanation.unobserved]
    exceptions = [f"exception {literal}" for literal in explanation.exceptions]
    return ", ".join([*events, *exceptions]) or "nothing unobserved"


def _intention(moment: Moment) -> str:
    trace = moment.decision.trace
    plan = f"; plan: {' '.join(trace.plan)}" if trace.plan else ""
    reason = f" ({trace.reason})" if trace.reason else ""
    return f"{trace.intention or '-'}{reason}{plan}"


def _action(moment: Moment) -> str:
    action = moment.decision.action
    if moment.happened is False:
        return f"{action}: did not happen"
    if action == FINISH and not moment.decision.believes_goal:
        return f"{action}: gives up"
    return action


def _tell_end(result: Result, say: Say) -> None:
    record = result.record
    say("")
    reason = f": {record.reason}" if record.reason else ""
    say(
        f"outcome {record.outcome}{reason} after {record.steps} steps, "
        f"{record.action_count} actions, {record.execution_units} execution units"
    )


def _recorded(folder: Path, spec: TrialSpec) -> TrialRecord | None:
    return next((r for r in read_records(folder) if r.trial == spec.trial), None)


def _compare(recorded: TrialRecord | None, now: TrialRecord, say: Say) -> bool:
    if recorded is None:
        say("the run has no record of this trial yet")
        return True
    before, after = logical(recorded), logical(now)
    changed = [key for key in before if before[key] != after[key]]
    if not changed:
        say("as recorded")
    for key in changed:
        say(f"differs from the record: {key} was {before[key]}, is {after[key]}")
    return not changed
