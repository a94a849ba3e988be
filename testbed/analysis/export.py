"""The table of a run as files for other programs: Parquet and CSV, written in pieces."""

import errno
import os
from collections.abc import Iterator
from pathlib import Path

import polars as pl

from testbed.analysis.columns import as_json
from testbed.analysis.table import BATCH, write_parquet
from testbed.experiment import StoreError
from testbed.experiment.run_folder import naming, read_config, replace_lines
from testbed.experiment.store import read_records

PARQUET, CSV = "trials.parquet", "trials.csv"
FORMULA = "^[=+@\t\r\n\u2212\uff1d\uff0b\uff0d\uff20-]"
"""How text begins that spreadsheets take for a formula."""


def export(folder: Path) -> tuple[Path, Path]:
    """Write the table of a run into its folder as `trials.parquet` and `trials.csv`; their paths.

    Raises:
        StoreError: for a folder without a run, or a run without trials.
        ConfigError: where the stored configuration is not valid any more.
    """
    read_config(folder)
    columnar, text = folder / PARQUET, folder / CSV
    draft = columnar.with_name(f"{PARQUET}.part")
    try:
        with naming(columnar):
            _write(folder, draft)
        if not pl.scan_parquet(draft).select(pl.len()).collect().item():
            raise StoreError(f"{folder}: has no trials to export yet")
        os.replace(draft, columnar)
    finally:
        draft.unlink(missing_ok=True)
    replace_lines(text, _csv(pl.scan_parquet(columnar)))
    return columnar, text


def _write(folder: Path, file: Path) -> None:
    """Write the table of a run. Raises OSError where the file cannot hold it."""
    try:
        write_parquet(read_records(folder), file)
    except pl.exceptions.ComputeError as error:
        if not str(error).startswith("parquet: "):
            raise
        raise OSError(errno.EIO, "cannot be written; the disk may be full") from None


def _csv(table: pl.LazyFrame) -> Iterator[bytes]:
    yield flat(table.head(0).collect()).write_csv().encode()
    for piece in table.collect_batches(chunk_size=BATCH, maintain_order=True):
        yield flat(piece).write_csv(include_header=False).encode()


def flat(trials: pl.DataFrame) -> pl.DataFrame:
    """The same with lists and parts of a record as JSON text, for CSV.

    Text that a spreadsheet would take for a formula has an apostrophe before it. Literals, which
    may begin with `-`, are in lists, whose text begins with a bracket: they stay as they are.
    """
    nested = [name for name, kind in trials.schema.items() if kind.is_nested()]
    texts = (
        pl.Series(
            name, [None if item is None else as_json(item) for item in trials[name].to_list()]
        )
        for name in nested
    )
    inert = trials.select(pl.col(pl.String).str.replace(FORMULA, "'$0"))
    return trials.with_columns(*inert, *(text.cast(pl.String) for text in texts))
