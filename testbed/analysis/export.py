"""The table of a run as files for other programs: Parquet and CSV, written in pieces."""

from collections.abc import Iterator
from pathlib import Path

import polars as pl

from testbed.analysis.columns import as_json
from testbed.analysis.stored_table import PARQUET, stored_table
from testbed.analysis.table import BATCH
from testbed.experiment import StoreError
from testbed.experiment.run_folder import read_config, replace_lines

CSV = "trials.csv"
FORMULA = "^[=+@\t\r\n\u2212\uff1d\uff0b\uff0d\uff20-]"
"""How text begins that spreadsheets take for a formula."""


def export(folder: Path) -> tuple[Path, Path]:
    """Write the table of a run into its folder as `trials.parquet` and `trials.csv`; their paths.

    Raises:
        StoreError: for a folder without a run, or a run without trials.
        ConfigError: where the stored configuration is not valid any more.
    """
    rows, text = stored_table(folder, read_config(folder)).rows, folder / CSV
    if not rows.select(pl.len()).collect().item():
        raise StoreError(f"{folder}: has no trials to export yet")
    replace_lines(text, _csv(rows))
    return folder / PARQUET, text


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
