"""The trials of a run for other programs: Parquet as they are, CSV with what is nested as JSON."""

from __future__ import annotations

from io import BytesIO
from pathlib import Path
from typing import Any

import msgspec
import polars as pl
from msgspec import inspect

from testbed.experiment.errors import StoreError
from testbed.experiment.record import TrialRecord
from testbed.experiment.store import naming, read_config, read_records

PARQUET, CSV = "trials.parquet", "trials.csv"
FORMULA = "^[=+@\t\r\n\u2212\uff1d\uff0b\uff0d\uff20-]"
"""How text begins that spreadsheets take for a formula."""
SCALARS: dict[type[inspect.Type], type[pl.DataType]] = {
    inspect.StrType: pl.String,
    inspect.LiteralType: pl.String,
    inspect.BoolType: pl.Boolean,
    inspect.IntType: pl.Int64,
    inspect.FloatType: pl.Float64,
}


def export(folder: Path) -> tuple[Path, Path]:
    """Write `trials.parquet` and `trials.csv` into a run folder, a row a trial; their paths.

    A record's keys are the columns, in their order.

    Raises:
        StoreError: for a folder without a run, or a run without trials.
        ConfigError: where the stored configuration is not valid any more.
    """
    read_config(folder)
    trials = frame(msgspec.to_builtins(record, enc_hook=str) for record in read_records(folder))
    if not len(trials):
        raise StoreError(f"{folder}: has no trials to export yet")
    paths = folder / PARQUET, folder / CSV
    columnar = BytesIO()
    trials.write_parquet(columnar)
    with naming(paths[0]):
        paths[0].write_bytes(columnar.getbuffer())
    with naming(paths[1]):
        paths[1].write_text(flat(trials).write_csv(), encoding="utf-8", newline="")
    return paths


def frame(rows: Any) -> pl.DataFrame:
    """Records as a data frame: every column has its type, also where it is always empty."""
    return pl.DataFrame(list(rows), schema=schema(), orient="row")


def schema() -> dict[str, pl.DataType]:
    """The columns with their types, from the record's own."""
    shape = inspect.type_info(TrialRecord)
    assert isinstance(shape, inspect.StructType)
    return {field.name: _column(field.type) for field in shape.fields}


def _column(kind: inspect.Type) -> pl.DataType:
    if isinstance(kind, inspect.UnionType):
        (kind,) = (item for item in kind.types if not isinstance(item, inspect.NoneType))
    if isinstance(kind, inspect.ListType):
        return pl.List(_column(kind.item_type))
    if isinstance(kind, inspect.StructType):
        return pl.Struct({field.name: _column(field.type) for field in kind.fields})
    return SCALARS[type(kind)]()


def flat(trials: pl.DataFrame) -> pl.DataFrame:
    """The same with lists and parts of a record as JSON text, for CSV.

    Text that a spreadsheet would take for a formula has an apostrophe before it. Literals, which
    may begin with `-`, are in lists, whose text begins with a bracket: they stay as they are.
    """
    nested = [name for name, kind in trials.schema.items() if kind.is_nested()]
    texts = (
        pl.Series(name, [None if item is None else _json(item) for item in trials[name].to_list()])
        for name in nested
    )
    inert = trials.select(pl.col(pl.String).str.replace(FORMULA, "'$0"))
    return trials.with_columns(*inert, *(text.cast(pl.String) for text in texts))


def _json(value: object) -> str:
    return msgspec.json.encode(value, enc_hook=str).decode()
