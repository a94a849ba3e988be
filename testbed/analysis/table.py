"""The trials of a run as one table, which everything about a run is made of."""

from collections.abc import Iterable, Iterator
from dataclasses import dataclass, replace
from functools import cache
from io import BytesIO
from itertools import islice
from pathlib import Path
from typing import Any

import msgspec
import polars as pl
from msgspec import inspect

from testbed.analysis import explanations
from testbed.config import ExperimentConfig, conditions_of
from testbed.experiment import StoreError
from testbed.experiment.origin import Origin
from testbed.experiment.record import TrialRecord
from testbed.experiment.run_folder import PROVENANCE, naming, read_config
from testbed.experiment.specs import Setting, TrialSpec
from testbed.experiment.store import read_records
from testbed.protocol import literal_within_bounds

PARTS: dict[str, type[msgspec.Struct]] = {"condition": Setting, "origin": Origin}
"""Keys of a record the parts of which have columns of their own, `KEY.PART`."""
PARQUET, CSV = "trials.parquet", "trials.csv"
BATCH = 1000
"""Records that are Python objects at the same time."""
FORMULA = "^[=+@\t\r\n\u2212\uff1d\uff0b\uff0d\uff20-]"
"""How text begins that spreadsheets take for a formula."""
SCALARS: dict[type[inspect.Type], type[pl.DataType]] = {
    inspect.StrType: pl.String,
    inspect.CustomType: pl.String,  # a literal
    inspect.LiteralType: pl.String,
    inspect.BoolType: pl.Boolean,
    inspect.IntType: pl.Int64,
    inspect.FloatType: pl.Float64,
}


@dataclass(frozen=True)
class Run:
    """A run folder as it was read: its configuration, provenance and trials.

    `trials` has one row per trial on record, in the order in which they ended, and one column per
    key of a record; what is nested there is a list or a struct here. `provenance` is what
    `provenance.json` holds, empty where there is none.
    """

    folder: Path
    config: ExperimentConfig
    provenance: dict[str, Any]
    trials: pl.DataFrame

    def records(self, *conditions: pl.Expr) -> Iterator[TrialRecord]:
        """The rows as records, one at a time; with conditions those that satisfy all of them."""
        return records_of(self.trials.filter(*conditions))

    @property
    def conditions(self) -> dict[str, "Run"]:
        """The run under each condition of its sweep, by name; of no sweep the run by ""."""
        if not self.config.is_sweep:
            return {"": self}
        return {
            name: replace(self, config=own, trials=self.trials.filter(cell=name))
            for name, own in conditions_of(self.config).items()
        }


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
    return Run(folder, config, known, table_of(read_records(folder, specs)))


def table_of(records: Iterable[TrialRecord]) -> pl.DataFrame:
    """Records as a table; every column has its type, also where it is always empty."""
    source, columns = iter(records), schema()
    frames = [pl.DataFrame(schema=columns)]
    while batch := [_row(own) for own in islice(source, BATCH)]:
        frames.append(pl.DataFrame(batch, schema=columns, orient="row"))
    return pl.concat(frames)


def records_of(trials: pl.DataFrame) -> Iterator[TrialRecord]:
    """The rows of a table as records."""
    rows = map(with_parts, trials.iter_rows(named=True))
    return (msgspec.convert(row, TrialRecord, dec_hook=literal_within_bounds) for row in rows)


def schema() -> dict[str, pl.DataType]:
    """The columns of the table with their types, which follow from those of a record.

    What a trial was played under has a column per key, `condition.KEY`, and where its record came
    from, `origin.KEY`; lists and parts of these are JSON text. What is counted of its explanations
    is in columns `quality.NAME`, derived from the record.
    """
    columns = {field.name: field.type for field in _fields(TrialRecord) if field.name not in PARTS}
    return {
        **{name: _column(kind) for name, kind in columns.items()},
        **{name: _scalar(own.type) or pl.String() for name, _, own in _parts()},
        **{
            name: pl.Int64() if kind is int else pl.Float64()
            for name, kind in explanations.KINDS.items()
        },
    }


@cache
def _parts() -> tuple[tuple[str, str, inspect.Field], ...]:
    """The columns of the parts: each with the key of the record, and the field of its part."""
    fields = ((key, own) for key, struct in PARTS.items() for own in _fields(struct))
    return tuple((f"{key}.{own.name}", key, own) for key, own in fields)


def _fields(struct: type[msgspec.Struct]) -> tuple[inspect.Field, ...]:
    shape = inspect.type_info(struct)
    assert isinstance(shape, inspect.StructType)
    return shape.fields


def _row(record: TrialRecord) -> dict[str, Any]:
    """A record as a row of the table."""
    row: dict[str, Any] = msgspec.to_builtins(record, enc_hook=str)
    for name, key, own in _parts():
        row[name] = _told(getattr(getattr(record, key), own.name, None))
    kept = {name: value for name, value in row.items() if name not in PARTS}
    return kept | explanations.columns_of(record)


def _told(value: object) -> object:
    return value if isinstance(value, bool | int | float | str | None) else _json(value)


def with_parts(row: dict[str, Any]) -> dict[str, Any]:
    """A row of the table with the parts of a record, as these are nested there."""
    for name in explanations.KINDS:
        row.pop(name, None)
    told: dict[str, dict[str, Any]] = {key: {} for key in PARTS}
    for name, key, own in _parts():
        value = row.pop(name, None)
        known = value is None or _scalar(own.type) is not None
        told[key][own.name] = value if known else msgspec.json.decode(value)
    # Older records have no such part.
    return row | {key: own for key, own in told.items() if any(v is not None for v in own.values())}


def _scalar(kind: inspect.Type) -> pl.DataType | None:
    """The type of the column of a value without parts; None of others."""
    if isinstance(kind, inspect.UnionType):
        kinds = [item for item in kind.types if not isinstance(item, inspect.NoneType)]
        return _scalar(kinds[0]) if len(kinds) == 1 else None
    return SCALARS[type(kind)]() if type(kind) in SCALARS else None


def _column(kind: inspect.Type) -> pl.DataType:
    if isinstance(kind, inspect.UnionType):
        (kind,) = (item for item in kind.types if not isinstance(item, inspect.NoneType))
    if isinstance(kind, inspect.ListType):
        return pl.List(_column(kind.item_type))
    if isinstance(kind, inspect.StructType):
        return pl.Struct({field.name: _column(field.type) for field in kind.fields})
    return SCALARS[type(kind)]()


def export(folder: Path) -> tuple[Path, Path]:
    """Write the table of a run into its folder as `trials.parquet` and `trials.csv`; their paths.

    Raises:
        StoreError: for a folder without a run, or a run without trials.
        ConfigError: where the stored configuration is not valid any more.
    """
    trials = load_run(folder).trials
    if not len(trials):
        raise StoreError(f"{folder}: has no trials to export yet")
    columnar = BytesIO()
    trials.write_parquet(columnar)
    texts = {PARQUET: columnar.getvalue(), CSV: flat(trials).write_csv().encode()}
    for name, text in texts.items():
        with naming(folder / name):
            (folder / name).write_bytes(text)
    return folder / PARQUET, folder / CSV


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
