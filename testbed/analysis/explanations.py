"""How well a robot explained what it was not told of: what is counted of the record of a trial.

An event is unobserved where the robot was not told of it before its next decision. An explanation
is judged by the events that are unobserved when it is adopted: that happened before, and of which
the robot has not been told by then.
"""

from collections import defaultdict
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from math import inf
from typing import Any, NamedTuple

from asp.language import Action, Literal
from testbed.experiment.record import At, Explained, TrialRecord


class Happening(NamedTuple):
    """An action at a step."""

    step: int
    action: Action


class Answer(NamedTuple):
    """The step of an explanation, and the step that it gives an event; None: it lacks the event."""

    adopted: int
    named: int | None


@dataclass(frozen=True)
class Quality:
    """What is counted of the explanations of a trial.

    Events: `unobserved` ones; those `followed` by an explanation before the robot was told of
    them, and in how many of these the first and the last such explanation has the action, and has
    it at its true step; those `explained`, which any of them has, and the mean `latency` of these:
    the steps from the event to the first explanation that has its action.
    Explanations: how many were `adopted`, the mean number of `alternatives` that are as small, and
    to how many there were more than are counted. Assumptions, each counted once: events that were
    `assumed`, and those of them that are `false`; `exceptions`, and `false_exceptions`; reports
    that were `distrusted`, and `wrongly_distrusted`.
    """

    unobserved: int
    followed: int
    action_first: int
    action_last: int
    step_first: int
    step_last: int
    explained: int
    latency: float | None
    adopted: int
    alternatives: float | None
    more_alternatives: int
    assumed: int
    false: int
    exceptions: int
    false_exceptions: int
    distrusted: int
    wrongly_distrusted: int


PREFIX = "quality."
"""How the columns of the table are called that hold these numbers."""
KINDS: Mapping[str, Any] = {PREFIX + name: kind for name, kind in Quality.__annotations__.items()}
"""The columns, and the types of their values."""


def columns_of(record: TrialRecord) -> dict[str, int | float | None]:
    """The numbers of a record by column.

    All are null at the fine resolution, where events are of one resolution and explanations of
    another.
    """
    if record.fine is not None:
        return dict.fromkeys(KINDS)
    return {PREFIX + name: value for name, value in vars(quality_of(record)).items()}


def quality_of(record: TrialRecord) -> Quality:
    """The numbers of a record of the coarse resolution."""
    adopted = [own for own in record.explanations if _assumes(own)]
    answers, assumed = _judged(unobserved(record), adopted)
    followed = [(event, own) for event, own in answers.items() if own]
    right = {e: next((a for a in own if a.named is not None), None) for e, own in followed}
    waits = [own.adopted - event.step for event, own in right.items() if own is not None]
    others = [own.alternatives for own in adopted if own.alternatives is not None]
    exceptions = {literal for own in adopted for literal in own.exceptions}
    distrusted = _distrusted(record, adopted)
    return Quality(
        unobserved=len(answers),
        followed=len(followed),
        action_first=sum(own[0].named is not None for _, own in followed),
        action_last=sum(own[-1].named is not None for _, own in followed),
        step_first=sum(own[0].named == event.step for event, own in followed),
        step_last=sum(own[-1].named == event.step for event, own in followed),
        explained=len(waits),
        latency=_mean(waits),
        adopted=len(adopted),
        alternatives=_mean(others),
        more_alternatives=sum(own.more_alternatives for own in adopted),
        assumed=len(assumed),
        false=sum(not is_true for is_true in assumed.values()),
        exceptions=len(exceptions),
        false_exceptions=sum(not _held(record, literal) for literal in exceptions),
        distrusted=len(distrusted),
        wrongly_distrusted=sum(distrusted.values()),
    )


def unobserved(record: TrialRecord) -> dict[Happening, float]:
    """The unobserved events, each with the step at which the robot was told of it; else infinity.

    An event that it was told of, in a record without reports, was told at once.
    """
    told: dict[Happening, float] = {}
    for report in record.reports:
        event = Happening(report.step, report.action)
        told[event] = min(report.told, told.get(event, inf))
    events: dict[Happening, float] = {}
    for own in record.exogenous:
        event = Happening(own.step, own.action)
        events[event] = told.get(event, event.step + 1 if own.observed else inf)
    return {event: step for event, step in events.items() if step > event.step + 1}


def matched(assumed: Iterable[Happening], true: Iterable[Happening]) -> dict[Happening, Happening]:
    """By true event the assumed one that has its action.

    Each assumed event stands for one true one. Of several with one action those at one step belong
    together; of the others the first assumed one to the first true one, and so on.
    """
    supposed, happened = set(assumed), set(true)
    found = {event: event for event in supposed & happened}
    left: defaultdict[Action, list[Happening]] = defaultdict(list)
    for event in sorted(supposed - happened):
        left[event.action].append(event)
    for event in sorted(happened - supposed):
        if left[event.action]:
            found[event] = left[event.action].pop(0)
    return found


def _judged(
    events: Mapping[Happening, float], adopted: Iterable[Explained]
) -> tuple[dict[Happening, list[Answer]], dict[Happening, bool]]:
    """By event the explanations that follow it, by assumed event whether its action is true.

    The latter is judged where it is first assumed.
    """
    answers: dict[Happening, list[Answer]] = {event: [] for event in events}
    truth: dict[Happening, bool] = {}
    for own in adopted:
        known = [event for event, told in events.items() if event.step < own.step < told]
        assumed = _happenings(own.unobserved)
        found = matched(assumed, known)
        for event in known:
            named = found[event].step if event in found else None
            answers[event].append(Answer(own.step, named))
        for event in assumed:
            truth.setdefault(event, event in found.values())
    return answers, truth


def _distrusted(record: TrialRecord, adopted: Iterable[Explained]) -> dict[Happening, bool]:
    """The reports that were taken for false, and whether they were true."""
    reports = {Happening(own.step, own.action): own.true for own in record.reports}
    taken = {event for own in adopted for event in _happenings(own.distrusted)}
    return {event: true for event, true in reports.items() if event in taken}


def _assumes(own: Explained) -> bool:
    return bool(own.unobserved or own.exceptions or own.distrusted or own.outcomes)


def _held(record: TrialRecord, literal: Literal) -> bool:
    """Whether a literal was true at step 0, of which the record has all true atoms."""
    return (literal.atom in record.initial) == literal.is_positive


def _happenings(events: Iterable[At]) -> list[Happening]:
    return [Happening(event.step, event.action) for event in events]


def _mean(values: list[int]) -> float | None:
    return sum(values) / len(values) if values else None
