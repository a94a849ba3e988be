"""Explanations as robots hold them, and as the kept controls give them."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import replace

from agents.shared.history import Diagnosis, History
from asp.reasoning.diagnosis import Assumed, Record
from testbed.protocol import Event


def happened_under(record: Record, diagnosis: Diagnosis, step: int) -> tuple[str, ...]:
    """The exogenous actions of a step, given an explanation."""
    false = {report.action for report in diagnosis.distrusted if report.step == step}
    unobserved = (event.action for event in diagnosis.unobserved if event.step == step)
    return (*(event for event in record.reported if event not in false), *unobserved)


def executed_under(record: Record, diagnosis: Diagnosis, step: int) -> str | None:
    """The agent's attempt of a step, given an explanation; None where none was executed."""
    if record.attempt is None or Event(step=step, action=record.attempt[0]) in diagnosis.distrusted:
        return None
    return record.attempt[0]


def without_reported(history: History, adopted: Diagnosis) -> Diagnosis:
    """What is left to assume of an explanation where some of its events were reported since."""
    unobserved = (e for e in adopted.unobserved if not history.at(e.step).happened.get(e.action))
    return replace(adopted, unobserved=tuple(unobserved))


def assumed_in(diagnosis: Diagnosis) -> Assumed:
    """An explanation without how it began."""
    return Assumed(
        tuple((event.step, event.action) for event in diagnosis.unobserved),
        tuple((report.step, report.action) for report in diagnosis.distrusted),
        diagnosis.exceptions,
    )


def events_of(pairs: Iterable[tuple[int, str]]) -> tuple[Event, ...]:
    """Happenings as they travel, in the order of their steps."""
    return tuple(Event(step=step, action=action) for step, action in sorted(pairs))
