"""The results of trials, which the same seed gives again, and one number for all of a run.

The digest covers a fixed list of fields, so that it stays the same when a record gains a field:
what a trial is (the seed, which follows from its seed path, scenario, level, robot, initial state,
goal), and what came of it (outcome, actions, exogenous events, explanations, mental actions, plans,
execution units). Ids, settings, times, statistics and prose are left out, and so are trials that
the clock had a part in (`deadline`), which need not end alike on another machine.
"""

import gzip
import hashlib
import heapq
from collections.abc import Iterable
from io import BytesIO
from typing import Any

import msgspec

from testbed.experiment.record import TIMES, At, TrialRecord

SORTED_TOGETHER = 5_000
"""Results, as lines of a few hundred bytes."""


def logical(record: TrialRecord) -> dict[str, object]:
    """The record without times, earlier attempts and origin: what the same seed must give."""
    kept = _timeless(msgspec.to_builtins(record, enc_hook=str))
    del kept["origin"]
    return kept | {"fine": None if record.fine is None else _timeless(kept["fine"])}


def _timeless(values: dict[str, Any]) -> dict[str, Any]:
    return {key: own for key, own in values.items() if not key.endswith((*TIMES, "retried"))}


def digest(records: Iterable[TrialRecord]) -> str:
    """The SHA-256 of the results in the records, in hexadecimal, whatever the records' order."""
    found = Digest()
    for record in records:
        found.add(record)
    return found.value


class Digest:
    """The digest of records that are given one at a time.

    What is not sorted yet is short; the rest is compressed, and merged in the end.
    """

    def __init__(self) -> None:
        self._lines: list[bytes] = []
        self._sorted: list[bytes] = []

    def add(self, record: TrialRecord) -> None:
        """Take a record in, unless the clock had a part in it."""
        if not record.deadline:
            self._lines.append(msgspec.json.encode(_results(record), enc_hook=str) + b"\n")
        if len(self._lines) == SORTED_TOGETHER:
            self._sorted.append(gzip.compress(b"".join(sorted(self._lines)), compresslevel=1))
            self._lines.clear()

    def taken(self, record: TrialRecord) -> TrialRecord:
        """The record, which is taken in."""
        self.add(record)
        return record

    @property
    def value(self) -> str:
        """The SHA-256 of the results in the records so far, in hexadecimal."""
        found, between = hashlib.sha256(), b""
        parts = (gzip.GzipFile(fileobj=BytesIO(part)) for part in self._sorted)
        for line in heapq.merge(sorted(self._lines), *parts):
            found.update(between + line[:-1])
            between = b"\n"
        return found.hexdigest()


def _results(record: TrialRecord) -> list[object]:
    """The fields of a record that the digest covers; another list changes every digest."""
    return [
        record.seed,
        record.scenario,
        record.level,
        record.robot,
        record.initial,
        record.goal,
        record.outcome,
        [[own.step, own.action, own.happened] for own in record.actions],
        [[event.step, event.action, event.observed] for event in record.exogenous],
        [
            [own.step, _at(own.unobserved), own.exceptions, _at(own.distrusted)]
            for own in record.explanations
        ],
        _at(record.mental),
        [record.plans, *([own.start, own.plan] for own in record.activities)],
        record.execution_units,
    ]


def _at(actions: Iterable[At]) -> list[list[object]]:
    return [[own.step, own.action] for own in actions]
