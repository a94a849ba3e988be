"""Whether the records of a run are those of its plan."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from pathlib import Path

from testbed.experiment.record import TrialRecord
from testbed.experiment.recorder import blank_record
from testbed.experiment.specs import TrialSpec
from testbed.experiment.store import damaged, numbered_records

GIVEN = ("pair", "scenario", "seed", "robot", "domain", "level", "initial", "goal")
"""Keys of a record that follow from the plan."""


def planned_records(folder: Path, specs: Iterable[TrialSpec]) -> Iterator[TrialRecord]:
    """As `read_records`; raises StoreError also for a record that is not of one of these trials."""
    planned = {spec.trial: spec for spec in specs}
    for number, record in numbered_records(folder):
        strange = strangeness(record, planned.get(record.trial))
        if strange is not None:
            raise damaged(folder, number, strange)
        yield record


def check_planned(folder: Path, specs: Iterable[TrialSpec]) -> None:
    """Raise StoreError, with its line, for a record that is not of one of these trials."""
    for _ in planned_records(folder, specs):
        pass


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
