"""The table of a run as `trials.parquet` beside its records, so that it is made of them once.

`table.json` says what the file was made of, and by which code. As long as all of that is the same
the file stands for the records, and is read in a fraction of the time.
"""

import errno
import os
from collections.abc import Iterable
from hashlib import file_digest
from io import BytesIO
from pathlib import Path
from typing import BinaryIO, NamedTuple

import msgspec
import polars as pl

from testbed.analysis.table import write_parquet
from testbed.config import ExperimentConfig
from testbed.experiment.digest import Digest
from testbed.experiment.fingerprint import fingerprint
from testbed.experiment.origin import sha256
from testbed.experiment.run_folder import TRIALS, flat_config, naming, replace_lines
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
    stored = _stored(folder, _hash(folder / TRIALS))
    if stored is not None:
        return stored
    made = BytesIO()
    digest = _write(folder, made)
    return Table(pl.scan_parquet(made.getvalue()), digest)


def stored_table(
    folder: Path, config: ExperimentConfig, specs: Iterable[TrialSpec] | None = None
) -> Table:
    """The same; a new one is stored.

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
    path = folder / PARQUET
    draft = path.with_name(f"{PARQUET}.part")
    try:
        with naming(path):
            digest = _write(folder, draft, specs)
        os.replace(draft, path)
    finally:
        draft.unlink(missing_ok=True)
    made_of = MadeOf(records, _hash_of(fingerprint()), _hash(path), digest, plan)
    replace_lines(folder / MADE_OF, [msgspec.json.encode(made_of), b"\n"])
    return Table(pl.scan_parquet(path.read_bytes()), digest)


def _write(folder: Path, target: Path | BinaryIO, specs: Iterable[TrialSpec] | None = None) -> str:
    """Write the table of a run; its digest. Raises OSError where the target cannot hold it."""
    digest = Digest()
    try:
        write_parquet(map(digest.taken, read_records(folder, specs)), target)
    except pl.exceptions.ComputeError as error:
        if not str(error).startswith("parquet: "):
            raise
        raise OSError(errno.EIO, "cannot be written; the disk may be full") from None
    return digest.value


def _stored(folder: Path, records: str, plan: str | None = None) -> Table | None:
    """The stored table where it was made of these records, and checked as is asked for."""
    try:
        told = msgspec.json.decode((folder / MADE_OF).read_bytes(), type=MadeOf)
        sound = told.table == _hash(folder / PARQUET) and told.code == _hash_of(fingerprint())
    except (FileNotFoundError, msgspec.DecodeError, UnicodeDecodeError, RecursionError):
        return None
    if not sound or told.records != records or plan not in (None, told.plan):
        return None
    return Table(pl.scan_parquet((folder / PARQUET).read_bytes()), told.digest)


def _hash_of(known: object) -> str:
    return sha256(msgspec.json.encode(known, order="sorted").decode())


def _hash(path: Path) -> str:
    """The SHA-256 of a file; empty where there is none."""
    try:
        with path.open("rb") as file:
            return file_digest(file, "sha256").hexdigest()
    except FileNotFoundError:
        return ""
