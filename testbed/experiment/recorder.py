"""Fill a trial's record while it is played."""

from collections.abc import Mapping

import msgspec

from asp.language import Action
from testbed.environment import Ending
from testbed.experiment.origin import here
from testbed.experiment.record import (
    TIMES,
    Activity,
    At,
    Attempt,
    Cause,
    Explained,
    FineCounts,
    Outcome,
    Report,
    TrialRecord,
)
from testbed.experiment.specs import TrialSpec, without_paths
from testbed.experiment.stories import Story, encode
from testbed.experiment.storyteller import Storyteller
from testbed.protocol import FINISH, WAIT, Decision, Event, Explanation, FineTrace, Trace, shortened

NAMED = ("trial", "pair", "scenario", "seed", "robot", "domain", "level", "cell")
"""Keys of a record that its trial has in the plan."""


class Result(msgspec.Struct):
    """A record, where the trial failed what is known of the failure, and the trial's story.

    `story` is a line of `stories.jsonl`, None once it is kept there.
    """

    record: TrialRecord
    details: str | None = None
    story: bytes | None = None

    def _repr_html_(self) -> str:
        """As of the record."""
        return self.record._repr_html_()


class Recorder:
    """The record of the trial under way, complete up to the last step that was played.

    `costs` are the execution units of actions; what has none counts 0. `teller` makes the trial's
    story, None until the trial begins.
    At the fine resolution its actions are the abstract ones. The robot says which concrete actions
    belong to which; whether an abstract action happened is what the robot inferred of it. One that
    the trial ends in the middle of did not happen.
    """

    def __init__(self, spec: TrialSpec) -> None:
        fine = spec.setting.fine
        self.record = blank_record(spec)
        self.record.origin = self.origin = here()
        self.costs: Mapping[str, int] = {}
        self.teller: Storyteller | None = None
        # Whether every action and every test comes out as it should.
        self._certain = fine is None or all(p == 1.0 for p in fine.statistics.values())
        self._last: Decision | None = None

    def step(self, decision: Decision, happened: bool | None) -> None:
        """What the robot decided; `happened` is None unless it attempted a physical action."""
        record, trace = self.record, decision.trace
        self._last = decision
        record.steps = decision.step
        record.plans = max(record.plans, trace.plans)
        _add_times(trace, record)
        record.reasoning_time_s = record.planning_time_s + record.diagnosis_time_s
        record.deadline = record.deadline or trace.deadline
        if trace.minimal is not None:
            record.unproved_steps = (record.unproved_steps or 0) + (trace.minimal == "unproved")
        if trace.unheeded is not None:
            record.unheeded_steps = (record.unheeded_steps or 0) + bool(trace.unheeded)
        if record.fine is None:
            if decision.action not in (WAIT, FINISH):
                self._attempt(decision.step, decision.action, bool(happened))
        elif trace.fine is not None:
            self._acted(decision.step, trace.fine, record.fine)
        mental = FINISH if decision.action == FINISH else trace.mental
        if mental is not None:
            record.mental.append(At(decision.step, mental))
        if trace.explanation is not None:
            record.explanations.append(_explained(decision.step, trace, trace.explanation))
        self._activity(decision.step, trace)

    def _attempt(self, step: int, action: Action, happened: bool) -> None:
        self.record.actions.append(Attempt(step, action, happened))
        self.record.action_count += 1
        self.record.execution_units += self.costs.get(action, 0)

    def _acted(self, step: int, fine: FineTrace, counts: FineCounts) -> None:
        """What was done at the fine resolution."""
        if fine.happened and self.record.actions:
            self.record.actions[-1].happened = True
        if fine.abstract is not None and fine.begun == step:
            self._attempt(step, fine.abstract, False)
        counts.plans, counts.actions, counts.tests = fine.plans, fine.actions, fine.tests
        _add_times(fine, counts)
        self.record.reasoning_time_s += counts.planning_time_s + counts.infer_time_s

    def _activity(self, step: int, trace: Trace) -> None:
        """Follow the activities; a robot without mental actions begins one with each plan."""
        mental, activities = trace.mental, self.record.activities
        if mental is not None and mental.name == "stop" and activities:
            activities[-1].stop = step
            activities[-1].futile_at = trace.futile_at
            activities[-1].reason = trace.reason or None
        if mental is not None and mental.name == "start":
            activities.append(Activity(int(mental.arguments[0]), step, list(trace.plan)))
        elif mental is None and trace.plans > len(activities):
            activities.append(Activity(trace.plans, step, list(trace.plan)))

    def report(self, told: int, event: Event) -> None:
        """What the robot is told at step `told`; after what truly happened was recorded."""
        told_of = event.step, event.action
        happened = [own for own in self.record.exogenous if (own.step, own.action) == told_of]
        for occurrence in happened:
            occurrence.observed = True
        self.record.reports.append(Report(told, event.step, event.action, bool(happened)))

    def end(self, ending: Ending) -> None:
        """The end of the game; after the record has `achieved` and the fewest actions."""
        record, last = self.record, self._last
        record.finished, record.outcome = ending.by_answer, ending.value
        if ending is Ending.FALSE_FINISH and last is not None and not last.believes_goal:
            record.outcome = "gave_up"
            record.reason = record.reason or last.trace.reason or None
            record.no_plan = last.trace.no_plan
        record.correct = record.achieved and record.finished and self._is_minimal()

    def _is_minimal(self) -> bool | None:
        """Whether undisturbed it took the fewest actions; None where these are not known."""
        if self.record.exogenous or not self._certain:
            return True
        least = self.record.minimal_actions
        return None if least is None else self.record.action_count == least

    def fail(self, outcome: Outcome, reason: str, cause: Cause) -> None:
        """The trial could not be played to its end; only of the robot's own error it is judged."""
        self.record.outcome = outcome
        self.record.correct = False if cause == "robot" else None
        self.record.reason, self.record.cause = shortened(reason), cause

    def result(self, details: str | None = None) -> Result:
        """The record with its story; of a trial that did not begin a story of no steps."""
        story = Story(trial=self.record.trial) if self.teller is None else self.teller.story
        return Result(self.record, details, encode(story))


def _add_times(trace: Trace | FineTrace, sums: TrialRecord | FineCounts) -> None:
    """Add the times of a step to those of the same names in the record."""
    for name in trace.__struct_fields__:
        if name.endswith(TIMES):
            setattr(sums, name, getattr(sums, name) + getattr(trace, name))


def _explained(step: int, trace: Trace, explanation: Explanation) -> Explained:
    return Explained(
        step,
        [At(event.step, event.action) for event in explanation.unobserved],
        list(explanation.exceptions),
        distrusted=[At(event.step, event.action) for event in explanation.distrusted],
        outcomes=[At(event.step, event.action) for event in explanation.outcomes],
        contradictions=trace.contradictions,
        alternatives=None if trace.alternatives is None else len(trace.alternatives),
        more_alternatives=trace.more_alternatives,
        minimal=explanation.minimal,
    )


def lost_worker(spec: TrialSpec, how: str) -> Result:
    """The result of a trial whose worker process ended in the middle of it; `how` is the reason."""
    recorder = Recorder(spec)
    recorder.fail("error", how, "infrastructure")
    return recorder.result()


def blank_record(spec: TrialSpec) -> TrialRecord:
    """A record with what is known before the trial is played."""
    return TrialRecord(
        **{key: getattr(spec, key) for key in NAMED},
        initial=list(spec.initial),
        goal=list(spec.setting.goal),
        condition=without_paths(spec.setting, spec.domain),
        fine=None if spec.setting.fine is None else FineCounts(),
    )


def strangeness(record: TrialRecord, spec: TrialSpec | None) -> str | None:
    """Why a record is not that of the planned trial with its id; None if it is."""
    if spec is None:
        return f"trial {record.trial} is not one of this run's"
    blank = blank_record(spec)
    for key in (*NAMED, "initial", "goal"):
        told, planned = getattr(record, key), getattr(blank, key)
        if told != planned:
            return f"trial {record.trial} has {key} {told!r}, not {planned!r}"
    if record.steps > spec.setting.step_limit:
        return (
            f"trial {record.trial} has {record.steps} steps, and {spec.setting.step_limit} end it"
        )
    return None
