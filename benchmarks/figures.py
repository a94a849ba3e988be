"""Pictures of sheets: times over what grows."""

from collections.abc import Sequence
from pathlib import Path

from matplotlib.axes import Axes
from matplotlib.figure import Figure

from benchmarks.sheets import Row, Sheet

INCHES = 3.4
SERIES = {
    "first_ms": "first, with grounding",
    "fast_median_ms": "multi-shot sessions",
    "reference_ms": "from scratch",
    "median_ms": "compressed",
    "99_ms": "compressed, 99th percentile",
    "whole_median_ms": "whole history",
}


def draw(sheets: Sequence[Sheet], path: Path) -> None:
    """A picture of the sheets over numbers, side by side; times on a log scale."""
    shown = [sheet for sheet in sheets if len(sheet.rows) > 1 and _is_curve(sheet)]
    figure = Figure(figsize=(INCHES * len(shown), INCHES), layout="constrained")
    for axes, sheet in zip(figure.subplots(1, len(shown), squeeze=False)[0], shown, strict=True):
        _curves(axes, sheet)
    figure.axes[0].set_ylabel("one decision (ms)")
    path.parent.mkdir(parents=True, exist_ok=True)
    figure.savefig(path, dpi=130)


def _is_curve(sheet: Sheet) -> bool:
    return not isinstance(next(iter(sheet.rows[0].values())), str)


def _curves(axes: Axes, sheet: Sheet) -> None:
    x = next(iter(sheet.rows[0]))
    kinds = dict.fromkeys(str(row.get("decision", "")) for row in sheet.rows)
    for kind in kinds:
        rows = [row for row in sheet.rows if str(row.get("decision", "")) == kind]
        for column, label in SERIES.items():
            points = _points(rows, x, column)
            if points:
                axes.plot(*zip(*points, strict=True), marker="o", label=f"{label} {kind}".strip())
    axes.set(xscale="log" if x == "step" else "linear", yscale="log", xlabel=x, title=sheet.name)
    axes.legend(frameon=False, fontsize="small")


def _points(rows: Sequence[Row], x: str, column: str) -> list[tuple[float, float]]:
    """The measured points; what was given up has none."""
    return [
        (float(at), float(value))
        for row in rows
        if isinstance(at := row[x], int | float)
        and isinstance(value := row.get(column), int | float)
    ]
