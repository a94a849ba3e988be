"""The records of a run: read from its folder, and appended to it as trials end.

Results of trials that failed before are kept beside the records until they take their places. A
run that is killed meanwhile loses neither: the old records stay where they are, and the new ones
take their places when the run goes on.
"""

import os
import shlex
from collections.abc import Iterable, Iterator, Mapping
from pathlib import Path
from typing import BinaryIO, Self

import msgspec

from testbed.experiment.encoding import TORN, encode, read_lines
from testbed.experiment.errors import StoreError
from testbed.experiment.record import FAILURES, TrialRecord
from testbed.experiment.recorder import strangeness
from testbed.experiment.run_folder import TRIALS, naming, replace_lines
from testbed.experiment.specs import TrialSpec
from testbed.protocol import shortened
from testbed.text import warn

RETRIES = "retries.jsonl"


def read_records(folder: Path, specs: Iterable[TrialSpec] | None = None) -> Iterator[TrialRecord]:
    """The records of a run, one at a time, also while it grows: a torn last line is left out.

    With `specs` each is checked to be that of one of these trials.

    Raises:
        StoreError: for a line in the middle that is not a record, a trial's second one, and one
            that is not of these trials.
    """
    path = folder / TRIALS
    if not path.is_file():
        return
    planned = None if specs is None else {spec.trial: spec for spec in specs}
    lines_of: dict[str, int] = {}
    for number, _, record, fault in read_lines(path):
        if fault == TORN:
            return
        if record is not None:
            first = lines_of.setdefault(record.trial, number)
            if first != number:
                fault = f"trial {record.trial} is on record at line {first} already"
            elif planned is not None:
                fault = strangeness(record, planned.get(record.trial))
        if record is None or fault is not None:
            remedy = f"'testbed repair {shlex.quote(str(folder))}' keeps what is whole"
            raise StoreError(f"{path}:{number}: {fault}; {remedy}")
        yield record


class TrialWriter:
    """Appends records to a run folder's `trials.jsonl`, which is to be locked meanwhile.

    Opening it drops a torn last line, and reads the records as `read_records` does; `done` then
    holds the ids of the trials on record, and `failures` the reasons of those that failed, the last
    one of each last. A later record of one of these takes its place when the writer is closed, or
    opened again after it was killed.
    """

    def __init__(self, folder: Path, specs: Iterable[TrialSpec] | None = None) -> None:
        folder.mkdir(parents=True, exist_ok=True)
        settle(folder)
        self._folder = folder
        self._files: dict[str, BinaryIO] = {}
        self._open(TRIALS)
        with (folder / TRIALS).open("r+b") as file:
            file.truncate(sum(len(line) for line in file if line.endswith(b"\n")))
        self.done: set[str] = set()
        self.failures: dict[str, list[str]] = {}
        for record in read_records(folder, specs):
            self.done.add(record.trial)
            if record.outcome in FAILURES:
                self.failures[record.trial] = [*record.retried, record.reason or ""]

    def append(self, record: TrialRecord) -> None:
        """Write one record, visible to readers at once, or in the place of another later."""
        record.retried = [*self.failures.get(record.trial, ()), *record.retried]
        file = self._open(RETRIES if record.trial in self.done else TRIALS)
        with naming(Path(file.name)):
            file.write(encode(record))
            file.flush()
        self.done.add(record.trial)

    def _open(self, name: str) -> BinaryIO:
        if name not in self._files:
            self._files[name] = (self._folder / name).open("ab")
        return self._files[name]

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        for file in self._files.values():
            with naming(Path(file.name)):
                os.fsync(file.fileno())
                file.close()
        settle(self._folder)


def settle(folder: Path) -> None:
    """Put the results of a retry in the places of the records of the same trials.

    A line of the retry that is damaged takes nobody's place. Results of trials without a record
    are dropped, which standard error says in one line. Raises StoreError for a record of
    a newer testbed.
    """
    retries = folder / RETRIES
    if not retries.is_file():
        return
    again = {line.record.trial: line.text for line in read_lines(retries) if line.record}
    (folder / TRIALS).touch()
    replaced: set[str] = set()
    with (folder / TRIALS).open("rb") as file:
        replace_lines(folder / TRIALS, _replaced(file, again, replaced))
    retries.unlink()
    lost = sorted(again.keys() - replaced)
    if lost:
        more = f" and {len(lost) - 1} more" if len(lost) > 1 else ""
        which = f"trial {shortened(lost[0], 40)}{more}"
        warn(f"{retries}: dropped the results of {which}: no records to replace in {TRIALS}")


def _replaced(lines: BinaryIO, again: Mapping[str, bytes], replaced: set[str]) -> Iterator[bytes]:
    """The lines, with those of a retry in their places; the trials of these are put in a set."""
    for line in lines:
        trial = _trial_of(line)
        replaced |= again.keys() & {trial}
        yield again.get(trial, line)


class _Named(msgspec.Struct):
    """Of a record its id."""

    trial: str


def _trial_of(line: bytes) -> str:
    """The id of the trial that a line, damaged or not, is the record of; empty where unknown."""
    try:
        return msgspec.json.decode(line, type=_Named).trial if line.endswith(b"\n") else ""
    except (msgspec.DecodeError, UnicodeDecodeError, RecursionError):
        return ""
