"""The results of trials, which the same seed gives again, and one number for all of a run.

The digest covers a fixed list of fields, so that it stays the same when a record gains a field:
what a trial is (the seed, which follows from its seed path, scenario, level, robot, initial state,
goal), and what came of it (outcome, actions, exogenous events, explanations, mental actions, plans,
execution units). Ids, settings, times, statistics and prose are left out, and so are trials that
the clock had a part in (`deadline`), which need not end alike on another machine.
"""

import hashlib
from collections.abc import Iterable
from typing import Any

import msgspec

from testbed.experiment.record import TIMES, At, TrialRecord


def logical(record: TrialRecord) -> dict[str, object]:
    """The record without times, earlier attempts and origin: what the same seed must give."""
    kept = _timeless(msgspec.to_builtins(record, enc_hook=str))
    del kept["origin"]
    return kept | {"fine": None if record.fine is None else _timeless(kept["fine"])}


def _timeless(values: dict[str, Any]) -> dict[str, Any]:
    return {key: own for key, own in values.items() if not key.endswith((*TIMES, "retried"))}


def digest(records: Iterable[TrialRecord]) -> str:
    """The SHA-256 of the results in the records, in hexadecimal, whatever the records' order."""
    timeless = (record for record in records if not record.deadline)
    lines = sorted(msgspec.json.encode(_results(record), enc_hook=str) for record in timeless)
    return hashlib.sha256(b"\n".join(lines)).hexdigest()


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
