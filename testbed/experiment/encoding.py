"""A record as a line of JSON with its version and checksum, and lines read as records."""

import re
from collections.abc import Iterator
from pathlib import Path
from typing import NamedTuple
from zlib import crc32

import msgspec

from testbed.experiment.errors import StoreError
from testbed.experiment.record import TrialRecord
from testbed.protocol import Count, literal_within_bounds

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


class NewerVersionError(StoreError):
    """A record that a newer testbed wrote: nothing is wrong with it, but it is not read here."""


class Line(NamedTuple):
    """A line of a file of records, with its record, or its fault where it is none."""

    number: int
    text: bytes
    record: TrialRecord | None
    fault: str | None


# Made here: msgspec reads what a type holds when it first needs it, and two threads that do so at
# once end the interpreter.
_decoder = msgspec.json.Decoder(TrialRecord, dec_hook=literal_within_bounds)
_seal = msgspec.json.Decoder(_Seal)


def encode(record: TrialRecord) -> bytes:
    """The record as one line of JSON with its version and checksum, newline included."""
    body = msgspec.json.encode(record, enc_hook=str)
    return b'{"version":%d,"crc32":"%08x",%s\n' % (VERSION, crc32(body), body[1:])


def check(record: TrialRecord) -> None:
    """Raise msgspec.ValidationError unless the record can be written and read again."""
    line = encode(record)
    if len(line) > MOST_BYTES:
        message = f"a record of {len(line)} bytes; {MOST_BYTES} are the most"
        raise msgspec.ValidationError(message)
    decode(line)


def decode(line: bytes) -> TrialRecord:
    """The record in a line.

    Raises:
        msgspec.DecodeError: for anything else, and where the checksum is not that of the line.
        NewerVersionError: for a record that a newer testbed wrote.
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
        raise NewerVersionError(f"{newer}; install the one that provenance.json names")


def read_lines(path: Path) -> Iterator[Line]:
    """The lines of a file of records. Raises StoreError for a record of a newer testbed."""
    with path.open("rb") as file:
        for number, text in enumerate(file, start=1):
            record, fault = None, None
            try:
                if text.endswith(b"\n"):
                    record = decode(text)
                else:
                    fault = TORN
            except msgspec.DecodeError as error:
                fault = f"not a record of a trial: {error}"
            except NewerVersionError as error:
                raise StoreError(f"{path}:{number}: {error}") from None
            yield Line(number, text, record, fault)
