"""Results of trials that failed before: kept beside the records until they take their places.

A run that is killed meanwhile loses neither: the old records stay where they are, and what is in
this file takes their places when the run goes on.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import BinaryIO

import msgspec

from testbed.experiment.errors import StoreError
from testbed.experiment.record import NewerVersionError, decode
from testbed.experiment.run_folder import TRIALS, replace_lines
from testbed.protocol import shortened
from testbed.text.terminal import warn

RETRIES = "retries.jsonl"


class _Named(msgspec.Struct):
    """Of a record its id."""

    trial: str


def trial_of(line: bytes) -> str | None:
    """The id of the trial that a line is the record of; None if it is none, or torn."""
    try:
        return msgspec.json.decode(line, type=_Named).trial if line.endswith(b"\n") else None
    except (msgspec.DecodeError, UnicodeDecodeError, RecursionError):
        return None


def _whole(path: Path, number: int, line: bytes) -> str | None:
    """The same, of nothing but a whole record."""
    try:
        return decode(line).trial if line.endswith(b"\n") else None
    except msgspec.DecodeError:
        return None
    except NewerVersionError as error:
        raise StoreError(f"{path}:{number}: {error}") from None


def settle(folder: Path) -> None:
    """Put the results of a retry in the places of the records of the same trials.

    A line of the retry that is damaged takes nobody's place. Results of trials without a record
    are dropped, which standard error says in one line. Raises StoreError for one that a newer
    testbed wrote.
    """
    retries = folder / RETRIES
    if not retries.is_file():
        return
    with retries.open("rb") as file:
        whole = ((_whole(retries, number, line), line) for number, line in enumerate(file, 1))
        again = {trial: line for trial, line in whole if trial is not None}
    (folder / TRIALS).touch()
    replaced: set[str] = set()
    with (folder / TRIALS).open("rb") as file:
        replace_lines(folder / TRIALS, _replaced(file, again, replaced))
    retries.unlink()
    lost = sorted(again.keys() - replaced)
    if lost:
        which = f"trial {shortened(lost[0], 40)}" + (
            f" and {len(lost) - 1} more" if len(lost) > 1 else ""
        )
        warn(f"{retries}: dropped the results of {which}: no records to replace in {TRIALS}")


def _replaced(lines: BinaryIO, again: Mapping[str, bytes], replaced: set[str]) -> Iterator[bytes]:
    """The lines, with those of a retry in their places; the trials of these are put in a set."""
    for line in lines:
        trial = trial_of(line) or ""
        replaced |= again.keys() & {trial}
        yield again.get(trial, line)
