"""The table of a run as `trials.parquet` beside its records, so that it is made of them once.

`table.json` says what the file was made of, and by which code. As long as all of that is the same
the file stands for the records, and is read in a fraction of the time.
"""

from collections.abc import Iterable
from hashlib import file_digest, sha256
from io import BytesIO
from pathlib import Path
from typing import NamedTuple

import msgspec
import polars as pl

from testbed.analysis.table import write_parquet
from testbed.config import ExperimentConfig
from testbed.experiment.digest import Digest
from testbed.experiment.fingerprint import fingerprint
from testbed.experiment.run_folder import TRIALS, flat_config, replace_lines
from testbed.experiment.specs import TrialSpec
from testbed.experiment.store import read_records

PARQUET, MADE_OF = "trials.parquet", "table.json"


class Table(NamedTuple):
    """All rows, compressed until a query needs them, and the digest of their results."""

    rows: pl.LazyFrame
    digest: str


class MadeOf(msgspec.Struct):
    """What a stored table is: hashes of the records, of the code, and of the table; the digest.

    `plan` is the hash of the configuration, where each record was checked to be of its trials.
    """

    records: str
    code: str
    table: str
    digest: str
    plan: str | None = None


def read_table(folder: Path) -> Table:
    """The table of a run: the stored one where it is that of the records, else a new one.

    Raises StoreError for a damaged record.
    """
    return _stored(folder, _hash(folder / TRIALS)) or made_table(folder).table


def stored_table(
    folder: Path, config: ExperimentConfig, specs: Iterable[TrialSpec] | None = None
) -> Table:
    """The same; a new one is stored, unless there is no record.

    With `specs`, which are the trials of the configuration, each record was checked to be that of
    one of these when the table was made.

    Raises:
        StoreError: for a damaged record, and one of another trial.
        OSError: where the table cannot be written.
    """
    records, plan = _hash(folder / TRIALS), None if specs is None else _hash_of(flat_config(config))
    stored = _stored(folder, records, plan)
    if stored is not None:
        return stored
    made = made_table(folder, specs)
    if made.rows:
        code, digest = _hash_of(fingerprint()), made.table.digest
        made_of = MadeOf(records, code, sha256(made.content).hexdigest(), digest, plan)
        replace_lines(folder / PARQUET, [made.content])
        replace_lines(folder / MADE_OF, [msgspec.json.encode(made_of), b"\n"])
    return made.table


class Made(NamedTuple):
    """A new table, its bytes as a file, and the number of its rows."""

    table: Table
    content: bytes
    rows: int


def made_table(folder: Path, specs: Iterable[TrialSpec] | None = None) -> Made:
    """A table made of the records. Raises StoreError as `stored_table`."""
    digest, target = Digest(), BytesIO()
    write_parquet(map(digest.taken, read_records(folder, specs)), target)
    rows = pl.scan_parquet(target.getvalue())
    number = rows.select(pl.len()).collect().item()
    return Made(Table(rows, digest.value), target.getvalue(), number)


def _stored(folder: Path, records: str, plan: str | None = None) -> Table | None:
    """The stored table where it was made of these records, and checked as is asked for.

    One that cannot be read, for whatever reason, is none.
    """
    files = folder / MADE_OF, folder / PARQUET
    try:
        if not all(map(Path.is_file, files)):  # a pipe would be waited for
            return None
        text, content = (file.read_bytes() for file in files)
        told = msgspec.json.decode(text, type=MadeOf)
    except (OSError, msgspec.DecodeError, UnicodeDecodeError, RecursionError):
        return None
    made_of = (told.records, told.code, told.table)
    if made_of != (records, _hash_of(fingerprint()), sha256(content).hexdigest()):
        return None
    if plan not in (None, told.plan):
        return None
    return Table(pl.scan_parquet(content), told.digest)


def _hash_of(known: object) -> str:
    return sha256(msgspec.json.encode(known, order="sorted")).hexdigest()


def _hash(path: Path) -> str:
    """The SHA-256 of a file; empty where there is none."""
    try:
        with path.open("rb") as file:
            return file_digest(file, "sha256").hexdigest()
    except FileNotFoundError:
        return ""
