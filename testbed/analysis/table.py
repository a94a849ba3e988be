"""The trials of a run as one table, which everything about a run is made of."""

from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from functools import cached_property
from io import BytesIO
from itertools import islice
from pathlib import Path
from typing import Any, BinaryIO, TypeAlias

import msgspec
import polars as pl
from polars.io.plugins import register_io_source

from testbed.analysis import explanations
from testbed.analysis.columns import PARTS, frame_of, parts, scalar, schema
from testbed.config import ExperimentConfig, conditions_of
from testbed.experiment.digest import Digest
from testbed.experiment.record import TrialRecord
from testbed.experiment.run_folder import PROVENANCE, read_config
from testbed.experiment.specs import TrialSpec
from testbed.experiment.store import read_records
from testbed.protocol import literal_within_bounds

Trials: TypeAlias = pl.DataFrame | pl.LazyFrame
"""A table of trials, or a query of one."""
BATCH = 1000
"""Records that are Python objects at the same time."""
ROW_GROUP = 2_000
"""Rows that are compressed together."""


@dataclass(frozen=True)
class Run:
    """A run folder as it was read: its configuration, provenance and trials.

    `table` has one row per trial on record, in the order in which they ended, and one column per
    key of a record; what is nested there is a list or a struct here. It is compressed, and of a
    query only the columns that it needs are not. `provenance` is what `provenance.json` holds,
    empty where there is none; `digest` is that of all results.
    """

    folder: Path
    config: ExperimentConfig
    provenance: dict[str, Any]
    table: pl.LazyFrame
    digest: str

    @cached_property
    def trials(self) -> pl.DataFrame:
        """The whole table."""
        return self.table.collect()

    def records(self, *conditions: pl.Expr) -> Iterator[TrialRecord]:
        """The rows as records, one at a time; with conditions those that satisfy all of them."""
        return records_of(self.table.filter(*conditions))

    @cached_property
    def conditions(self) -> dict[str, ExperimentConfig]:
        """The configuration under each condition of its sweep, by name; of no sweep by ""."""
        return conditions_of(self.config)


def load_run(
    folder: str | Path,
    config: ExperimentConfig | None = None,
    specs: Iterable[TrialSpec] | None = None,
) -> Run:
    """Read a run folder, each record once; also while the run goes on.

    `config` is in place of the stored configuration. With `specs` each record is checked to be that
    of one of these trials.

    Raises:
        StoreError: for a folder without a run, and for a damaged record, with its line.
        ConfigError: where the stored configuration is not valid any more.
    """
    folder = Path(folder)
    config, provenance = config or read_config(folder), folder / PROVENANCE
    known = msgspec.json.decode(provenance.read_bytes()) if provenance.is_file() else {}
    digest, stored = Digest(), BytesIO()
    write_parquet(_taken(read_records(folder, specs), digest), stored)
    return Run(folder, config, known, pl.scan_parquet(stored.getvalue()), digest.value)


def _taken(records: Iterable[TrialRecord], digest: Digest) -> Iterator[TrialRecord]:
    for record in records:
        digest.add(record)
        yield record


def table_of(records: Iterable[TrialRecord]) -> pl.DataFrame:
    """Records as a table; every column has its type, also where it is always empty."""
    return pl.concat([frame_of([]), *frames_of(records)])


def frames_of(records: Iterable[TrialRecord]) -> Iterator[pl.DataFrame]:
    """Records as a table in pieces of at most `BATCH` rows."""
    source = iter(records)
    while batch := list(islice(source, BATCH)):
        yield frame_of(batch)


def write_parquet(records: Iterable[TrialRecord], target: Path | BinaryIO) -> None:
    """Write the table of records; there is never more of it than a group of rows."""
    frames = frames_of(records)
    source = register_io_source(lambda *_: frames, schema=schema())
    source.sink_parquet(target, row_group_size=ROW_GROUP)


def records_of(trials: Trials) -> Iterator[TrialRecord]:
    """The rows of a table as records, one at a time."""
    for piece in trials.lazy().collect_batches(chunk_size=BATCH, maintain_order=True):
        for row in piece.iter_rows(named=True):
            yield msgspec.convert(with_parts(row), TrialRecord, dec_hook=literal_within_bounds)


def with_parts(row: dict[str, Any]) -> dict[str, Any]:
    """A row of the table with the parts of a record, as these are nested there."""
    for name in explanations.KINDS:
        row.pop(name, None)
    told: dict[str, dict[str, Any]] = {key: {} for key in PARTS}
    for name, key, own in parts():
        value = row.pop(name, None)
        known = value is None or scalar(own.type) is not None
        told[key][own.name] = value if known else msgspec.json.decode(value)
    # Older records have no such part.
    return row | {key: own for key, own in told.items() if any(v is not None for v in own.values())}
