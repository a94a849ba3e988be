"""The records of a run: one line of JSON each, with its version and checksum, appended and read.

Results of trials that failed before are kept beside the records until they take their places. A
run that is killed meanwhile loses neither: the old records stay where they are, and the new ones
take their places when the run goes on.
"""

import os
import re
import shlex
from collections.abc import Iterable, Iterator
from pathlib import Path
from typing import BinaryIO, Self
from zlib import crc32

import msgspec

from testbed.experiment.errors import StoreError
from testbed.experiment.record import FAILURES, TrialRecord
from testbed.experiment.recorder import strangeness
from testbed.experiment.run_folder import STORIES, TRIALS, naming, replace_lines
from testbed.experiment.specs import TrialSpec
from testbed.protocol import Count, literal_within_bounds, shortened
from testbed.text import warn

RETRIES = "retries.jsonl"
MOST_BYTES = 4 * 2**20
"""Of one record as a line."""
VERSION = 1
"""Of the keys of a record. Lines without a version, which older testbeds wrote, are 0."""
SEAL = re.compile(rb'\{"version":(\d+),"crc32":"([0-9a-f]{8})",')
"""How a line begins; the checksum is that of the rest of the line, a brace before it."""
TORN = "torn"
"""The fault of a line that does not end; it is the last one of its file."""


class _Seal(msgspec.Struct):
    """What a line says of itself, wherever in it."""

    version: Count = 0
    crc32: str | None = None


class _Named(msgspec.Struct):
    """Of a record its id, whatever else is damaged."""

    trial: str


# Made here: msgspec reads what a type holds when it first needs it, and two threads that do so at
# once end the interpreter.
_decoder = msgspec.json.Decoder(TrialRecord, dec_hook=literal_within_bounds)
_seal = msgspec.json.Decoder(_Seal)


def encode(record: TrialRecord) -> bytes:
    """The record as one line of JSON with its version and checksum, newline included."""
    return sealed(msgspec.json.encode(record, enc_hook=str))


def sealed(body: bytes) -> bytes:
    """A record that is JSON already, as such a line."""
    return b'{"version":%d,"crc32":"%08x",%s\n' % (VERSION, crc32(body), body[1:])


def check(record: TrialRecord) -> None:
    """Raise msgspec.ValidationError unless the record can be written and read again."""
    line = encode(record)
    if len(line) > MOST_BYTES:
        raise msgspec.ValidationError(f"a record of {len(line)} bytes; {MOST_BYTES} are the most")
    decode(line)


def decode(line: bytes) -> TrialRecord:
    """The record in a line.

    Raises:
        msgspec.DecodeError: for anything else, and where the checksum is not that of the line.
        StoreError: for a record that a newer testbed wrote, with which nothing is wrong.
    """
    try:
        _check_seal(line)
        return _decoder.decode(line)
    except (UnicodeDecodeError, RecursionError) as error:
        raise msgspec.DecodeError(str(error)) from error


def _check_seal(line: bytes) -> None:
    """A line without version and checksum is an older one, and is read as it is."""
    told = SEAL.match(line)
    if told is None:
        seal = _seal.decode(line)
        version, sound = seal.version, seal.crc32 is None
    else:
        version = int(told[1])
        sound = int(told[2], 16) == crc32(b"{" + line[told.end() :].rstrip(b"\n"))
    if not sound:
        raise msgspec.DecodeError("its checksum (crc32) is not that of the line")
    if version > VERSION:
        newer = f"a record of version {version}, and this testbed reads up to {VERSION}"
        raise StoreError(f"{newer}; install the one that provenance.json names")


def read_lines(path: Path) -> Iterator[tuple[int, bytes, TrialRecord | None, str | None]]:
    """The lines of a file of records: number and text, the record, and the fault where it is none.

    Raises StoreError for a record of a newer testbed.
    """
    with path.open("rb") as file:
        for number, text in enumerate(file, start=1):
            try:
                record, fault = (decode(text), None) if text.endswith(b"\n") else (None, TORN)
            except msgspec.DecodeError as error:
                record, fault = None, f"not a record of a trial: {error}"
            except StoreError as error:
                raise StoreError(f"{path}:{number}: {error}") from None
            yield number, text, record, fault


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
    """Appends records and stories to those of a run folder, which is to be locked meanwhile.

    Opening it drops torn last lines, and reads the records as `read_records` does; `done` then
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
        for path in (folder / TRIALS, folder / STORIES):
            if path.is_file():
                _drop_torn_line(path)
        self.done: set[str] = set()
        self.failures: dict[str, list[str]] = {}
        for record in read_records(folder, specs):
            self.done.add(record.trial)
            if record.outcome in FAILURES:
                self.failures[record.trial] = [*record.retried, record.reason or ""]

    def append(self, record: TrialRecord) -> None:
        """Write one record, visible to readers at once, or in the place of another later."""
        record.retried = [*self.failures.get(record.trial, ()), *record.retried]
        self._write(RETRIES if record.trial in self.done else TRIALS, encode(record))
        self.done.add(record.trial)

    def tell(self, story: bytes) -> None:
        """Write a line of `stories.jsonl`, visible at once; the last one of a trial counts."""
        self._write(STORIES, story)

    def _write(self, name: str, line: bytes) -> None:
        file = self._open(name)
        with naming(Path(file.name)):
            file.write(line)
            file.flush()

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


def _drop_torn_line(path: Path) -> None:
    """Cut off what stands behind the last line of a file that is whole."""
    with path.open("r+b") as file:
        file.truncate(sum(len(line) for line in file if line.endswith(b"\n")))


def settle(folder: Path) -> None:
    """Put the results of a retry in the places of the records of the same trials.

    A line of the retry that is damaged takes nobody's place. Results of trials without a record
    are dropped, which standard error says in one line. Raises StoreError for a record of
    a newer testbed.
    """
    retries, trials = folder / RETRIES, folder / TRIALS
    if not retries.is_file():
        return
    again = {record.trial: text for _, text, record, _ in read_lines(retries) if record}
    trials.touch()
    with trials.open("rb") as file:
        lost = sorted(again.keys() - set(map(_trial_of, file)))
        file.seek(0)
        replace_lines(trials, (again.get(_trial_of(line), line) for line in file))
    retries.unlink()
    if lost:
        more = f" and {len(lost) - 1} more" if len(lost) > 1 else ""
        which = f"trial {shortened(lost[0], 40)}{more}"
        warn(f"{retries}: dropped the results of {which}: no records to replace in {TRIALS}")


def _trial_of(line: bytes) -> str:
    """The id of the trial that a line, damaged or not, is the record of; empty where unknown."""
    try:
        return msgspec.json.decode(line, type=_Named).trial if line.endswith(b"\n") else ""
    except (msgspec.DecodeError, UnicodeDecodeError, RecursionError):
        return ""
