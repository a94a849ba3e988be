"""What a benchmark found: sheets of rows, printed as tables and written as JSON."""

import json
import os
import platform
import sys
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import asdict, dataclass
from importlib.metadata import version
from pathlib import Path

from rich.console import Console
from rich.table import Table

Value = str | int | float | bool | None
Row = Mapping[str, Value]


@dataclass(frozen=True)
class Sheet:
    """A table: its rows all have the same columns; `notes` say how it is to be read.

    The unit of a number stands in the name of its column (`median_ms`). None is what could not be
    measured, text such as `> 60 s` what was given up.
    """

    name: str
    title: str
    rows: Sequence[Row]
    notes: Sequence[str] = ()


def gathered(rows: Iterable[Row]) -> list[Row]:
    """The rows, each told on standard error as soon as it is measured: a run takes minutes."""
    found: list[Row] = []
    for row in rows:
        print(json.dumps(row), file=sys.stderr, flush=True)
        found.append(row)
    return found


class DisagreementError(AssertionError):
    """Two sides of a comparison gave different answers to one question."""


def show(sheet: Sheet, console: Console) -> None:
    """Prints a sheet."""
    columns = list(sheet.rows[0]) if sheet.rows else []
    table = Table(title=sheet.title, caption="\n".join(sheet.notes), caption_justify="left")
    for column in columns:
        numeric = any(isinstance(row[column], int | float) for row in sheet.rows)
        table.add_column(column.replace("_", " "), justify="right" if numeric else "left")
    for row in sheet.rows:
        table.add_row(*(_cell(row[column]) for column in columns))
    console.print(table)


def write(sheets: Sequence[Sheet], path: Path, size: str, seconds: float) -> None:
    """Writes the sheets of one benchmark, with what they were measured on, as JSON."""
    content = {
        "benchmark": path.stem,
        "size": size,
        "seconds": round(seconds, 1),
        "machine": machine(),
        "sheets": [asdict(sheet) for sheet in sheets],
    }
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(json.dumps(content, indent=1) + "\n", encoding="utf-8")


def machine() -> dict[str, Value]:
    """What times depend on."""
    return {
        "python": platform.python_version(),
        "clingo": version("clingo"),
        "system": platform.platform(),
        "processors": os.cpu_count(),
        "load": round(os.getloadavg()[0], 2),
    }


def _cell(value: Value) -> str:
    if value is None:
        return "–"
    if isinstance(value, bool):
        return "yes" if value else "no"
    if isinstance(value, float):
        return f"{value:,.0f}" if abs(value) >= 100 else f"{value:.3g}"
    return f"{value:,}" if isinstance(value, int) else value
