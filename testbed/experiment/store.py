"""The run folder: records appended as trials end, and everything needed to go on or run again."""

from __future__ import annotations

import fcntl
import os
from collections.abc import Iterator
from pathlib import Path
from types import TracebackType
from typing import BinaryIO, Self

import msgspec

from testbed.experiment.errors import StoreError
from testbed.experiment.record import FAILURES, TrialRecord, decode, encode
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
    "flat_config",
    "holds_run",
    "read_config",
    "read_records",
    "replace_text",
    "write_config",
]


def read_records(folder: Path) -> Iterator[TrialRecord]:
    """The records of a run, one at a time, also while it grows: a torn last line is left out.

    Raises:
        StoreError: for a line in the middle that is not a record.
    """
    path = folder / TRIALS
    if not path.is_file():
        return
    with path.open("rb") as lines:
        for number, line in enumerate(lines, start=1):
            if not line.endswith(b"\n"):
                return
            try:
                yield decode(line)
            except msgspec.DecodeError as error:
                raise StoreError(f"{path}:{number}: not a record of a trial: {error}") from None


class TrialWriter:
    """Appends records to a run folder's `trials.jsonl`; at most one writer a folder.

    Opening it drops a torn last line; `done` then holds the ids of the trials on record, and
    `failed` counts those that ended in error or lost their robot.
    """

    def __init__(self, folder: Path) -> None:
        folder.mkdir(parents=True, exist_ok=True)
        self._file: BinaryIO = (folder / TRIALS).open("ab")
        try:
            fcntl.flock(self._file, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except OSError:
            self._file.close()
            raise StoreError(f"{folder}: another run is writing here") from None
        _drop_torn_line(folder / TRIALS)
        self.done: set[str] = set()
        self.failed = 0
        for record in read_records(folder):
            self._count(record)

    def append(self, record: TrialRecord) -> None:
        """Write one record, visible to readers at once."""
        self._file.write(encode(record))
        self._file.flush()
        self._count(record)

    def _count(self, record: TrialRecord) -> None:
        self.done.add(record.trial)
        self.failed += record.outcome in FAILURES

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        os.fsync(self._file.fileno())
        self._file.close()


def _drop_torn_line(path: Path) -> None:
    with path.open("r+b") as file:
        end = file.seek(0, os.SEEK_END)
        while end > 0:
            file.seek(end - 1)
            if file.read(1) == b"\n":
                break
            end -= 1
        file.truncate(end)
