"""Play a stored trial again, in this process, and tell it step by step."""

from __future__ import annotations

import shlex
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
from testbed.experiment.wording import counted, explanation, in_words
from testbed.link.inprocess import InProcessRobot
from testbed.link.messages import Trace

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
    result = play_trial(spec, InProcessRobot(make_robot), Teller(world, say).tell)
    _tell_end(result, say)
    return _compare(_recorded(folder, spec), result.record, say)


def list_trials(folder: Path, say: Say) -> None:
    """Say which trials a run has, with their outcomes so far. Raises as `replay`."""
    specs = plan_trials(read_config(folder))
    outcomes = {record.trial: record.outcome for record in read_records(folder)}
    rows = [("trial", "scenario", "robot", "outcome")]
    rows += [
        (s.trial, s.scenario, s.robot, in_words(outcomes.get(s.trial, "not played yet")))
        for s in specs
    ]
    widths = [max(map(len, column)) for column in zip(*rows, strict=True)]
    for row in rows:
        cells = (cell.ljust(width) for cell, width in zip(row, widths, strict=True))
        say("  ".join(cells).rstrip())
    command = f"testbed replay {shlex.quote(str(folder))} --trial"
    say(f"choose one by its id, or the beginning of it: {command} {rows[-1][0]}")


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
    raise StoreError(
        f"--trial {trial}: not one of the run's {counted(len(known), 'trial')}; {hint}"
    )


class Teller:
    """Tells a trial while it is played; what is as at the step before is not told again."""

    def __init__(self, world: World, say: Say) -> None:
        self._world = world
        self._say = say
        self._plan: tuple[str, ...] = ()
        self._believed = False

    def tell(self, moment: Moment) -> None:
        """Tell one step."""
        for line in self._lines(moment):
            self._say(line)

    def _lines(self, moment: Moment) -> Iterator[str]:
        trace = moment.decision.trace
        yield ""
        yield f"step {moment.percept.step}"
        truth = sorted(self._world.true_atoms(moment.before))
        yield f"  world        {' '.join(truth)}"
        if moment.percept.goal_holds is False:
            yield "  told         the goal does not hold"
        if moment.percept.events:
            news = (f"{event.action} at step {event.step}" for event in moment.percept.events)
            yield f"  told         {', '.join(news)}"
        yield f"  belief       {self._belief(trace)}"
        if trace.belief and sorted(trace.belief) != truth:
            yield f"               in truth {_difference(trace.belief, truth)}"
        for contrary in trace.contradictions:
            against = f"{contrary.observed} at step {contrary.step} against {contrary.believed}"
            yield f"  unexpected   {against}"
        if trace.explanation is not None:
            yield f"  explanation  {explanation(trace.explanation)}"
        yield from (f"    or         {explanation(other)}" for other in trace.alternatives)
        if trace.more_alternatives:
            yield "    or         others, not all of which are listed"
        yield f"  intention    {trace.intention or '-'}{self._new_plan(trace)}"
        if trace.reason:
            yield f"  because      {trace.reason}"
        yield f"  action       {_action(moment)}"
        if moment.event is not None:
            yield f"  others       {moment.event}"

    def _belief(self, trace: Trace) -> str:
        if trace.belief:
            self._believed = True
            return " ".join(sorted(trace.belief))
        return "as before" if self._believed else "not reported"

    def _new_plan(self, trace: Trace) -> str:
        """The plan, unless it is what is left of the one told last."""
        plan, told = tuple(trace.plan), self._plan
        self._plan = plan or told
        return f"; plan: {' '.join(plan)}" if plan != told[len(told) - len(plan) :] else ""


def _difference(belief: Iterable[str], truth: Iterable[str]) -> str:
    missing, wrong = sorted(set(truth) - set(belief)), sorted(set(belief) - set(truth))
    return " ".join([*missing, *(f"-{atom}" for atom in wrong)])


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
    steps, actions = counted(record.steps, "step"), counted(record.action_count, "action")
    units = counted(record.execution_units, "execution unit")
    say(f"outcome {record.outcome}{reason} after {steps}, {actions}, {units}")


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
    if recorded.outcome == "robot_lost":
        say(
            f"recorded as robot lost: {recorded.reason}; a robot that was lost there need not be "
            "lost again, for here it runs in this process and without a limit to its time"
        )
        return True
    for key in changed:
        say(f"differs from the record: {key} was {before[key]}, is {after[key]}")
    return not changed
