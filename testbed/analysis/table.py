"""Records as a table, which everything about a run is made of, and its rows as records."""

from collections.abc import Iterable, Iterator
from itertools import islice
from pathlib import Path
from typing import Any, BinaryIO, TypeAlias

import msgspec
import polars as pl
from polars.io.plugins import register_io_source

from testbed.analysis import explanations
from testbed.analysis.columns import PARTS, frame_of, parts, scalar, schema
from testbed.experiment.record import TrialRecord
from testbed.protocol import literal_within_bounds

Trials: TypeAlias = pl.DataFrame | pl.LazyFrame
"""A table of trials, or a query of one."""
BATCH = 1000
"""Records that are Python objects at the same time."""
ROW_GROUP = 2_000
"""Rows that are compressed together."""


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
