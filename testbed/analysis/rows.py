"""Read one trial from a file: a line of `trials.jsonl`, or a row of a run's table as JSON."""

from pathlib import Path

import msgspec

from testbed.analysis.table import with_parts
from testbed.experiment import StoreError
from testbed.experiment.record import TrialRecord
from testbed.experiment.store import SEAL, decode

MOST_BYTES = 16 * 2**20
"""Of a row with its texts."""
FORMS = "give one line of trials.jsonl, or what 'testbed replay DIR --trial ID --row' writes"


class _WithTexts(msgspec.Struct):
    texts: dict[str, str] = {}


_texts = msgspec.json.Decoder(_WithTexts)


def read_row(file: Path) -> tuple[TrialRecord, dict[str, str]]:
    """The record in a file, and the texts that came with it, by what they are.

    Raises:
        StoreError: for anything else than one record, and one that a newer testbed wrote.
    """
    if file.stat().st_size > MOST_BYTES:
        raise StoreError(f"{file}: has more than {MOST_BYTES} bytes, which no row has; {FORMS}")
    try:
        line = _line(file.read_bytes())
        return decode(line), _texts.decode(line).texts
    except (msgspec.DecodeError, UnicodeDecodeError, RecursionError) as error:
        raise StoreError(f"{file}: is not the row of one trial: {error}; {FORMS}") from None
    except StoreError as error:
        raise StoreError(f"{file}: {error}") from None


def _line(text: bytes) -> bytes:
    """The row as a line is; what was not written as one has no checksum any more.

    Raises msgspec.DecodeError for anything else than one row.
    """
    rows = text.splitlines()
    if len(rows) == 1 and SEAL.match(text):
        return text
    if len(rows) > 1 and SEAL.match(rows[1]):
        raise msgspec.DecodeError(f"it has {len(rows)} lines")
    row = msgspec.json.decode(text)
    if isinstance(row, list) and len(row) == 1:  # a table with one row
        (row,) = row
    if not isinstance(row, dict):
        raise msgspec.DecodeError("it is no single mapping")
    return msgspec.json.encode(with_parts({key: row[key] for key in row if key != "crc32"}))
