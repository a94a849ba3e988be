"""Maps of values: one row per place, one column per series, the darker the larger the value."""

from collections.abc import Callable, Mapping
from typing import Any

from matplotlib.axes import Axes
from matplotlib.patches import Rectangle

from testbed.studies import Chart
from testbed.text import plain

FAINTEST, DARKEST = 0.04, 0.7
"""Opacity of the smallest and of the largest value: text stays readable on both."""
FORMS: Mapping[str, Callable[[float], str]] = {
    "share heat": lambda value: f"{value:.0%}",
    "number heat": lambda value: f"{value:.1f}",
}
"""How values are written, by the kind of the map."""


def draw_map(axes: Axes, chart: Chart, colour: str, ink: Any) -> None:
    """Draw a map on empty axes: fields in shades of a colour, with their values."""
    written = FORMS[chart.kind]
    values = [point.value for series in chart.series for point in series.points]
    least, most = min(0.0, *values), max(values, default=0.0)
    for column, series in enumerate(chart.series):
        for point in series.points:
            row = chart.places.index(point.place)
            part = (point.value - least) / (most - least) if most > least else 0.0
            shade = FAINTEST + part * (DARKEST - FAINTEST)
            field = Rectangle((column - 0.5, row - 0.5), 1, 1, facecolor=colour, alpha=shade)
            axes.add_patch(field)
            axes.text(column, row, written(point.value), ha="center", va="center", color=ink)
    axes.set_xlim(-0.5, len(chart.series) - 0.5)
    axes.set_ylim(len(chart.places) - 0.5, -0.5)
    names = [plain(series.label).replace("-", "-\n") for series in chart.series]
    axes.set_xticks(range(len(names)), names)
    axes.set_yticks(range(len(chart.places)), list(map(plain, chart.places)))
    axes.xaxis.tick_top()
    for side in ("left", "bottom"):
        axes.spines[side].set_visible(False)
