"""The run folder: records appended as trials end, and everything needed to go on or run again."""

from __future__ import annotations

import os
import shlex
from collections.abc import Iterator
from pathlib import Path
from types import TracebackType
from typing import BinaryIO, Self

import msgspec

from testbed.experiment.errors import StoreError
from testbed.experiment.record import (
    FAILURES,
    NewerVersionError,
    TrialRecord,
    decode,
    encode,
)
from testbed.experiment.retries import RETRIES, settle
from testbed.experiment.run_config import (
    check_unchanged,
    config_text,
    flat_config,
    read_config,
    write_config,
)
from testbed.experiment.run_folder import (
    CONFIG,
    ERRORS,
    PROVENANCE,
    REPORT,
    SUMMARY,
    TRIALS,
    choose_folder,
    holds_run,
    locked,
    naming,
    refuse_second_run,
    replace_text,
)

__all__ = [
    "CONFIG",
    "ERRORS",
    "PROVENANCE",
    "REPORT",
    "SUMMARY",
    "TRIALS",
    "TrialWriter",
    "check_unchanged",
    "choose_folder",
    "config_text",
    "damaged",
    "flat_config",
    "holds_run",
    "locked",
    "naming",
    "numbered_records",
    "read_config",
    "read_records",
    "refuse_second_run",
    "replace_text",
    "write_config",
]


def read_records(folder: Path) -> Iterator[TrialRecord]:
    """The records of a run, one at a time, also while it grows: a torn last line is left out.

    Raises:
        StoreError: for a line in the middle that is not a record, or a trial's second one.
    """
    return (record for _, record in numbered_records(folder))


def numbered_records(folder: Path) -> Iterator[tuple[int, TrialRecord]]:
    """As `read_records`, each with the number of its line."""
    path = folder / TRIALS
    if not path.is_file():
        return
    lines_of: dict[str, int] = {}
    with path.open("rb") as lines:
        for number, line in enumerate(lines, start=1):
            if not line.endswith(b"\n"):
                return
            record = _record(line, folder, number)
            first = lines_of.setdefault(record.trial, number)
            if first != number:
                again = f"trial {record.trial} is on record at line {first} already"
                raise damaged(folder, number, again)
            yield number, record


def damaged(folder: Path, number: int, what: str) -> StoreError:
    """The error that a line of a run's records is."""
    remedy = f"testbed repair {shlex.quote(str(folder))}"
    return StoreError(f"{folder / TRIALS}:{number}: {what}; '{remedy}' keeps what is whole")


def _record(line: bytes, folder: Path, number: int) -> TrialRecord:
    try:
        return decode(line)
    except msgspec.DecodeError as error:
        raise damaged(folder, number, f"not a record of a trial: {error}") from None
    except NewerVersionError as error:
        raise StoreError(f"{folder / TRIALS}:{number}: {error}") from None


class TrialWriter:
    """Appends records to a run folder's `trials.jsonl`, which is to be locked meanwhile.

    Opening it drops a torn last line; `done` then holds the ids of the trials on record, and
    `failures` the reasons of those that failed, the last one of each last. A later record of one
    of these takes its place when the writer is closed, or opened again after it was killed.
    """

    def __init__(self, folder: Path) -> None:
        folder.mkdir(parents=True, exist_ok=True)
        settle(folder)
        self._folder = folder
        self._files: dict[str, BinaryIO] = {}
        self._open(TRIALS)
        _drop_torn_line(folder / TRIALS)
        self.done: set[str] = set()
        self.failures: dict[str, list[str]] = {}
        for record in read_records(folder):
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

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        for file in self._files.values():
            with naming(Path(file.name)):
                os.fsync(file.fileno())
                file.close()
        settle(self._folder)


def _drop_torn_line(path: Path) -> None:
    with path.open("r+b") as file:
        end = file.seek(0, os.SEEK_END)
        while end > 0:
            file.seek(end - 1)
            if file.read(1) == b"\n":
                break
            end -= 1
        file.truncate(end)
