"""Tables 2 and 3 of a run: reasoning at each level, beside the published figures."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from typing import Any

from rich.table import Table

from testbed.experiment.levels.published import NO_ZOOM, PARTS, PUBLISHED, RATIOS, ZOOM

LEVEL_COLUMNS = ("level", "reasoning", "achieved", "all", "fine", "coarse", "a refined plan")
CONDITIONS = {ZOOM: "zoom", NO_ZOOM: "no zoom"}
Cells = tuple[str, ...]


def level_rows(summary: Mapping[str, Any]) -> list[Cells]:
    """The rows under LEVEL_COLUMNS: a level's robots, the paper's, and the ratios of both."""
    return [
        row
        for level, group in summary["levels"].items()
        if "reasoning" in group
        for row in _level(level, group)
    ]


def _level(level: str, group: Mapping[str, Any]) -> Iterator[Cells]:
    for robot, columns in group["reasoning"].items():
        yield (level, CONDITIONS.get(robot, robot), _achieved(columns), *_ours(columns))
        if (level, robot) in PUBLISHED:
            paper = PUBLISHED[level, robot]
            theirs = (_spread(*paper.seconds[p]) if p in paper.seconds else "-" for p in PARTS)
            yield (level, "  published", f"{100 * paper.completed:.0f} %", *theirs)
    ratios = group["zoom_ratios"]
    if any(ratio is not None for ratio in ratios.values()):
        yield (level, "no zoom / zoom", "", *(_times(ratios[part]) for part in PARTS))
        if level in RATIOS:
            yield (level, "  published", "", *(_times(RATIOS[level][part]) for part in PARTS))


def _achieved(columns: Mapping[str, Any]) -> str:
    """How many, and of the others how many had a goal out of reach."""
    out = f", {columns['out_of_reach']} out of reach" if columns["out_of_reach"] else ""
    return f"{columns['achieved']}/{columns['trials']}{out}"


def _ours(columns: Mapping[str, Any]) -> Iterator[str]:
    for part in PARTS:
        own = columns[part]
        yield "-" if own is None else _spread(own["mean"], own["sd"])


def _spread(mean: float, deviation: float) -> str:
    """Seconds as text: in ms where they are few."""
    if mean < 1.0:
        return f"{1000 * mean:.1f} ± {1000 * deviation:.1f} ms"
    return f"{mean:.2f} ± {deviation:.2f} s"


def _times(ratio: float | None) -> str:
    return "-" if ratio is None else f"{ratio:.2f}"


def rich_level_table(rows: Sequence[Cells]) -> Table:
    """The table for a terminal, with an empty line between levels."""
    table = Table(*LEVEL_COLUMNS, box=None, padding=(0, 2, 0, 0), collapse_padding=True)
    for column in table.columns:
        column.no_wrap = True
    for column in table.columns[3:]:
        column.justify = "right"
    for before, row in zip((None, *rows), rows, strict=False):
        if before is not None and before[0] != row[0]:
            table.add_row()
        table.add_row(*row)
    return table
