"""Fill a trial's record while it is played."""

from __future__ import annotations

from collections.abc import Mapping

import msgspec

from testbed.environment import FINISH, WAIT, Ending
from testbed.experiment.record import (
    Activity,
    At,
    Attempt,
    Cause,
    Contradicted,
    Explained,
    FineCounts,
    Minimal,
    Occurrence,
    Outcome,
    Rejected,
    Report,
    TrialRecord,
)
from testbed.experiment.specs import TrialSpec
from testbed.protocol import Decision, Event, Explanation, FineTrace, NoPlan, Trace, shortened

GIVEN = ("pair", "scenario", "seed", "robot", "domain", "level", "initial", "goal")
"""Keys of a record that follow from the plan."""


class Result(msgspec.Struct):
    """A record, and where the trial failed what is known of the failure."""

    record: TrialRecord
    details: str | None = None

    def _repr_html_(self) -> str:
        """As of the record."""
        return self.record._repr_html_()


class Recorder:
    """The record of the trial under way, complete up to the last step that was played."""

    def __init__(self, record: TrialRecord) -> None:
        self.record = record
        self._believes_goal = False
        self._last_reason: str | None = None
        self._no_plan: NoPlan | None = None

    def minimal(self, least: Minimal) -> None:
        """The least that achieves the goal from the initial state."""
        record = self.record
        record.minimal_actions, record.minimal_units, record.minimal_reason = least

    def step(self, decision: Decision, happened: bool | None, costs: Mapping[str, int]) -> None:
        """What the robot decided; `happened` is None unless it attempted a physical action."""
        record, trace = self.record, decision.trace
        record.steps = decision.step
        record.plans = max(record.plans, trace.plans)
        record.planning_time_s += trace.planning_time_s
        record.diagnosis_time_s += trace.diagnosis_time_s
        record.reasoning_time_s = record.planning_time_s + record.diagnosis_time_s
        record.planning_cpu_s += trace.planning_cpu_s
        record.diagnosis_cpu_s += trace.diagnosis_cpu_s
        record.preparation_cpu_s += trace.preparation_cpu_s
        record.deadline = record.deadline or trace.deadline
        self._believes_goal = decision.believes_goal
        self._last_reason, self._no_plan = trace.reason or None, trace.no_plan
        self._acted(decision, happened, costs)
        self._mind(decision.step, decision.action, trace)

    def _acted(self, decision: Decision, happened: bool | None, costs: Mapping[str, int]) -> None:
        if decision.action not in (WAIT, FINISH):
            self._attempt(decision.step, decision.action, bool(happened), costs)

    def _attempt(self, step: int, action: str, happened: bool, costs: Mapping[str, int]) -> None:
        self.record.actions.append(Attempt(step, action, happened))
        self.record.action_count += 1
        self.record.execution_units += costs.get(action, 0)

    def _mind(self, step: int, action: str, trace: Trace) -> None:
        record = self.record
        mental = FINISH if action == FINISH else trace.mental
        if mental is not None:
            record.mental.append(At(step, mental))
        if trace.explanation is not None:
            record.explanations.append(_explained(step, trace, trace.explanation))
        self._activity(step, trace)

    def _activity(self, step: int, trace: Trace) -> None:
        """Follow the activities; a robot without mental actions begins one with each plan."""
        kind, _, name = (trace.mental or "").rstrip(")").partition("(")
        activities = self.record.activities
        if kind == "stop" and activities:
            activities[-1].stop = step
            activities[-1].futile_at = trace.futile_at
            activities[-1].reason = trace.reason or None
        if kind == "start":
            activities.append(Activity(int(name), step, list(trace.plan)))
        elif not kind and trace.plans > len(activities):
            activities.append(Activity(trace.plans, step, list(trace.plan)))

    def exogenous(self, step: int, action: str) -> None:
        """An exogenous action that took effect at `step`."""
        self.record.exogenous.append(Occurrence(step, action, observed=False))

    def report(self, told: int, event: Event) -> None:
        """What the robot is told at step `told`; after what truly happened was recorded."""
        happened = [
            e for e in self.record.exogenous if (e.step, e.action) == (event.step, event.action)
        ]
        for occurrence in happened:
            occurrence.observed = True
        self.record.reports.append(Report(told, event.step, event.action, bool(happened)))

    def achieved(self, truly: bool) -> None:
        """Whether the goal holds in the world where the trial stops, whatever stops it."""
        self.record.achieved = truly

    def in_reach(self, still: bool | None) -> None:
        """Whether the goal could still be achieved where the trial ended; None: not known."""
        self.record.in_reach = still

    def end(self, ending: Ending) -> None:
        """The end of the game; after `achieved` and `minimal`."""
        record = self.record
        record.finished = ending is not Ending.STEP_LIMIT
        record.outcome = self._outcome(ending)
        if record.outcome == "gave_up":
            record.reason, record.no_plan = record.reason or self._last_reason, self._no_plan
        record.correct = (
            record.achieved and record.finished and (self._disturbed() or self._is_minimal())
        )

    def _outcome(self, ending: Ending) -> Outcome:
        if ending is Ending.STEP_LIMIT:
            return "step_limit"
        if ending is Ending.ACHIEVED:
            return "achieved"
        return "false_finish" if self._believes_goal else "gave_up"

    def _disturbed(self) -> bool:
        return bool(self.record.exogenous)

    def _is_minimal(self) -> bool | None:
        """Whether the fewest actions were taken; None where these are not known."""
        least = self.record.minimal_actions
        return None if least is None else self.record.action_count == least

    def rejected(self, step: int, action: str, reason: str) -> None:
        """An exogenous action of the script that was not possible at `step`."""
        self.record.rejected.append(Rejected(step, action, shortened(reason)))

    def note(self, reason: str) -> None:
        """What is to be known of a trial that was played to its end."""
        self.record.reason = reason

    def fail(self, outcome: Outcome, reason: str, cause: Cause) -> None:
        """The trial could not be played to its end; only of the robot's own error it is judged."""
        self.record.outcome = outcome
        self.record.correct = False if cause == "robot" else None
        self.record.reason, self.record.cause = shortened(reason), cause


def _explained(step: int, trace: Trace, explanation: Explanation) -> Explained:
    return Explained(
        step,
        [At(event.step, event.action) for event in explanation.unobserved],
        list[str](explanation.exceptions),
        distrusted=[At(event.step, event.action) for event in explanation.distrusted],
        contradictions=[Contradicted(c.step, c.observed, c.believed) for c in trace.contradictions],
        alternatives=len(trace.alternatives),
        more_alternatives=trace.more_alternatives,
        minimal=explanation.minimal,
    )


class FineRecorder(Recorder):
    """The record of a trial at the fine resolution: its actions are the abstract ones.

    The robot says which concrete actions belong to which; whether an abstract action happened is
    what the robot inferred of it. One that the trial ends in the middle of did not happen.
    """

    def __init__(self, record: TrialRecord, counts: FineCounts, certain: bool) -> None:
        """`certain`: whether every action and every test comes out as it should."""
        super().__init__(record)
        self._counts = counts
        self._certain = certain

    def _acted(self, decision: Decision, happened: bool | None, costs: Mapping[str, int]) -> None:
        del happened  # of a concrete action, which is told from what came of the abstract one
        fine = decision.trace.fine
        if fine is None:
            return
        if fine.happened and self.record.actions:
            self.record.actions[-1].happened = True
        if fine.begun == decision.step:
            self._attempt(fine.begun, fine.abstract, False, costs)
        self._count(fine)

    def _disturbed(self) -> bool:
        return not self._certain or super()._disturbed()

    def _count(self, fine: FineTrace) -> None:
        counts = self._counts
        counts.plans, counts.actions, counts.tests = fine.plans, fine.actions, fine.tests
        counts.planning_time_s += fine.planning_time_s
        counts.infer_time_s += fine.infer_time_s
        counts.planning_cpu_s += fine.planning_cpu_s
        counts.infer_cpu_s += fine.infer_cpu_s
        self.record.reasoning_time_s += counts.planning_time_s + counts.infer_time_s


def lost_worker(spec: TrialSpec, exit_code: int | None) -> Result:
    """The result of a trial whose worker process ended in the middle of it."""
    recorder = recorder_of(spec)
    reason = f"worker process ended with exit code {exit_code}"
    recorder.fail("error", reason, "infrastructure")
    return Result(recorder.record)


def recorder_of(spec: TrialSpec) -> Recorder:
    """The recorder of a trial, at its resolution."""
    record, fine = blank_record(spec), spec.setting.fine
    if fine is None or record.fine is None:
        return Recorder(record)
    certain = all(probability == 1.0 for probability in fine.statistics.values())
    return FineRecorder(record, record.fine, certain)


def blank_record(spec: TrialSpec) -> TrialRecord:
    """A record with what is known before the trial is played."""
    return TrialRecord(
        trial=spec.trial,
        pair=spec.pair,
        scenario=spec.scenario,
        seed=spec.seed,
        robot=spec.robot,
        domain=spec.domain,
        level=spec.level,
        initial=list(spec.initial),
        goal=list(spec.setting.goal),
        fine=None if spec.setting.fine is None else FineCounts(),
    )


def strangeness(record: TrialRecord, spec: TrialSpec | None) -> str | None:
    """Why a record is not that of the planned trial with its id; None if it is."""
    if spec is None:
        return f"trial {record.trial} is not one of this run's"
    blank = blank_record(spec)
    for key in GIVEN:
        told, planned = getattr(record, key), getattr(blank, key)
        if told != planned:
            return f"trial {record.trial} has {key} {told!r}, not {planned!r}"
    return None
