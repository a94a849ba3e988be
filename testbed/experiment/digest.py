"""One number for all results of a run, times aside: equal wherever and however it was played."""

from __future__ import annotations

import hashlib
from collections.abc import Iterable

import msgspec

from testbed.experiment.record import TrialRecord, logical


def digest(records: Iterable[TrialRecord]) -> str:
    """The SHA-256 of the records without their times, whatever their order in the file."""
    of_each = sorted((record.trial, _of(record)) for record in records)
    return hashlib.sha256(b"".join(own for _, own in of_each)).hexdigest()


def _of(record: TrialRecord) -> bytes:
    line = msgspec.json.encode(logical(record), order="deterministic")
    return hashlib.sha256(line).digest()
