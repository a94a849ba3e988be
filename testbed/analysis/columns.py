"""Columns of a table made of records: one per key, nested as the records are."""

from collections.abc import Sequence
from functools import cache
from itertools import chain
from operator import attrgetter
from typing import Any

import msgspec
import numpy as np
import polars as pl
from msgspec import inspect

from testbed.analysis import explanations
from testbed.experiment.origin import Origin
from testbed.experiment.record import TrialRecord
from testbed.experiment.specs import Setting

PARTS: dict[str, type[msgspec.Struct]] = {"condition": Setting, "origin": Origin}
"""Keys of a record the parts of which have columns of their own, `KEY.PART`."""
SCALARS: dict[type[inspect.Type], type[pl.DataType]] = {
    inspect.StrType: pl.String,
    inspect.CustomType: pl.String,  # a literal
    inspect.LiteralType: pl.String,
    inspect.BoolType: pl.Boolean,
    inspect.IntType: pl.Int64,
    inspect.FloatType: pl.Float64,
}


def schema() -> dict[str, pl.DataType]:
    """The columns of the table with their types, which follow from those of a record.

    What a trial was played under has a column per key, `condition.KEY`, and where its record came
    from, `origin.KEY`; lists and parts of these are JSON text. What is counted of its explanations
    is in columns `quality.NAME`, derived from the record.
    """
    return {
        **{own.name: _type(own.type) for own in _keys()},
        **{name: scalar(own.type) or pl.String() for name, _, own in parts()},
        **{
            name: pl.Int64() if kind is int else pl.Float64()
            for name, kind in explanations.KINDS.items()
        },
    }


def frame_of(records: Sequence[TrialRecord]) -> pl.DataFrame:
    """Records as a table, one row each; every column has its type, also where it is empty."""
    types, counted = schema(), [explanations.columns_of(record) for record in records]
    columns = {own.name: _column(own.type, _each(records, own.name)) for own in _keys()}
    for key in PARTS:
        columns |= _of_part(key, _each(records, key))
    for name in explanations.KINDS:
        columns[name] = pl.Series([own[name] for own in counted], dtype=types[name])
    return pl.DataFrame(columns)


def _each(values: Sequence[Any], name: str) -> list[Any]:
    return list(map(attrgetter(name), values))


def _column(kind: inspect.Type, values: list[Any]) -> pl.Series:
    """Values of a type as a column; what is nested is put into columns of its own first."""
    own = _present(kind)
    if isinstance(own, inspect.ListType):
        return _lists(values, _column(own.item_type, list(chain.from_iterable(values))))
    if isinstance(own, inspect.StructType):
        known = [value for value in values if value is not None]
        fields = {part.name: _column(part.type, _each(known, part.name)) for part in own.fields}
        return _with_nulls(pl.DataFrame(fields).to_struct(), values)
    return pl.Series(values, dtype=SCALARS[type(own)])


def _lists(values: Sequence[list[Any]], items: pl.Series) -> pl.Series:
    """Lists of these lengths, of these items one after the other."""
    rows = np.repeat(np.arange(len(values)), [len(value) for value in values])
    full = pl.DataFrame({"row": rows, "items": items}).group_by("row", maintain_order=True)
    lists = full.agg("items")["items"].extend(pl.Series([[]], dtype=pl.List(items.dtype)))
    return _placed(lists, [bool(value) for value in values], len(lists) - 1)


def _with_nulls(present: pl.Series, values: Sequence[Any]) -> pl.Series:
    return _placed(present, [value is not None for value in values], None)


def _placed(found: pl.Series, has: Sequence[bool], other: int | None) -> pl.Series:
    """What was found, in order, in the rows that have it; elsewhere the item number `other`."""
    own = iter(range(len(has)))
    rows = [next(own) if each else other for each in has]
    return found.gather(pl.Series(rows, dtype=pl.UInt32))


def _of_part(key: str, values: Sequence[Any]) -> dict[str, pl.Series]:
    """The columns of a part, which few trials have of their own: each text is there once."""
    numbers: dict[bytes, int] = {}
    first: list[Any] = []
    rows = []
    for value in values:
        text = msgspec.json.encode(value, enc_hook=str)
        if text not in numbers:
            first.append(value)
        rows.append(numbers.setdefault(text, len(numbers)))
    return {
        name: pl.Series(
            [as_told(getattr(value, own.name, None)) for value in first],
            dtype=scalar(own.type) or pl.String(),
        ).gather(rows)
        for name, part, own in parts()
        if part == key
    }


@cache
def parts() -> tuple[tuple[str, str, inspect.Field], ...]:
    """The columns of the parts: each with the key of the record, and the field of its part."""
    fields = ((key, own) for key, struct in PARTS.items() for own in _fields(struct))
    return tuple((f"{key}.{own.name}", key, own) for key, own in fields)


@cache
def _keys() -> tuple[inspect.Field, ...]:
    """The keys of a record that have one column."""
    return tuple(own for own in _fields(TrialRecord) if own.name not in PARTS)


def _fields(struct: type[msgspec.Struct]) -> tuple[inspect.Field, ...]:
    shape = inspect.type_info(struct)
    assert isinstance(shape, inspect.StructType)
    return shape.fields


def as_told(value: object) -> object:
    """A value of a part: JSON text where it is nested."""
    return value if isinstance(value, bool | int | float | str | None) else as_json(value)


def as_json(value: object) -> str:
    """A value as JSON text."""
    return msgspec.json.encode(value, enc_hook=str).decode()


def scalar(kind: inspect.Type) -> pl.DataType | None:
    """The type of the column of a value without parts; None of others."""
    own = _present(kind)
    return SCALARS[type(own)]() if type(own) in SCALARS else None


def _type(kind: inspect.Type) -> pl.DataType:
    own = _present(kind)
    if isinstance(own, inspect.ListType):
        return pl.List(_type(own.item_type))
    if isinstance(own, inspect.StructType):
        return pl.Struct({field.name: _type(field.type) for field in own.fields})
    return SCALARS[type(own)]()


def _present(kind: inspect.Type) -> inspect.Type:
    """The type of a value that is not None; of several the union itself."""
    if not isinstance(kind, inspect.UnionType):
        return kind
    own = [item for item in kind.types if not isinstance(item, inspect.NoneType)]
    return own[0] if len(own) == 1 else kind
