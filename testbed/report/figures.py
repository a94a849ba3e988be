"""Charts as figures of matplotlib: SVG that stands in a page and takes its colours from there."""

import io
import re
import warnings
from collections.abc import Callable, Mapping, Sequence
from textwrap import fill
from typing import Any, NamedTuple

import matplotlib as mpl
from markupsafe import Markup, escape
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import FixedLocator, FuncFormatter, NullLocator

from testbed.report.heat import FORMS, draw_map
from testbed.studies import Chart, Series
from testbed.text import plain

WIDTH = 3.2
ROW_HEIGHT, FRAME_HEIGHT = 0.33, 0.45
APART, ASIDE = 0.24, 0.1
LEVELS_HEIGHT = 2.6
MAP_HEIGHT = 0.28
LETTERS = 45
"""Of a line above a figure."""
TICKS = (0.01, 0.02, 0.05, 0.1, 0.2, 0.5, 1, 2, 5, 10, 20, 50, 100)
ROOM = 1.15
SHARES = ([0, 0.25, 0.5, 0.75, 1], ["0", "25", "50", "75", "100 %"])
"""Where axes of shares are marked, and how."""
INK, SOFT, LINE, CARD = "#010101", "#010102", "#010103", "#010104"
COLOURS = {"first": "#010105", "second": "#010106", "paper": "#010107"}
"""Those of series, by name."""
VARIABLES: Mapping[str, str] = {
    INK: "--ink",
    SOFT: "--soft",
    LINE: "--line",
    CARD: "--card",
    **{colour: f"--{name}" for name, colour in COLOURS.items()},
}
"""Colours that stand for custom properties of the page, which has them in light and in dark."""

SETTINGS: Any = {  # matplotlib names every setting that there is in its type
    "svg.fonttype": "none",
    "text.parse_math": False,  # a name with $ in it is no formula
    "font.size": 8.5,
    **dict.fromkeys(("axes.edgecolor", "grid.color"), LINE),
    **dict.fromkeys(("axes.labelcolor", "xtick.color", "ytick.color", "xtick.labelcolor"), SOFT),
    **dict.fromkeys(("axes.spines.top", "axes.spines.right"), False),
    "ytick.labelcolor": INK,
    "grid.linewidth": 0.6,
    "lines.linewidth": 1.4,
    "lines.markersize": 4.5,
}


class Panel(NamedTuple):
    """A figure of its own, with what it shows in words."""

    name: str
    title: str
    svg: Markup


def drawn(chart: Chart) -> Panel:
    """A chart as a figure: curves over the places, one row per place, or a map."""
    with mpl.rc_context(SETTINGS), warnings.catch_warnings():
        warnings.filterwarnings("ignore", r"Glyph \d+")  # no font has every character
        if chart.kind in FORMS:
            own = _map(chart)
        else:
            own = _curves(chart, CURVES[chart.kind]) if chart.kind in CURVES else _forest(chart)
        labels = ", ".join(series.label for series in chart.series)
        told = plain(f"{chart.title}: {labels}. The table has the numbers.")
        return Panel(chart.name, chart.title, _inline(own, chart.name, told))


def _forest(chart: Chart) -> Figure:
    """Values with intervals: ratios on a log scale around 1, or shares."""
    rows, series = chart.places, chart.series
    figure, axes = _blank(WIDTH, FRAME_HEIGHT + ROW_HEIGHT * len(rows))
    for number, own in enumerate(series):
        shift = APART * (number - (len(series) - 1) / 2)
        _dots(axes, own, {row: index + shift for index, row in enumerate(rows)})
    axes.set_yticks(range(len(rows)), list(map(plain, rows)))
    axes.set_ylim(len(rows) - 0.4, -0.6)
    for edge in range(1, len(rows)):
        axes.axhline(edge - 0.5, color=LINE, linewidth=0.6, zorder=0)
    for side in ("left", "bottom"):
        axes.spines[side].set_visible(False)
    _shares(axes) if chart.kind == "shares" else _ratios(axes, series)
    return figure


def _map(chart: Chart) -> Figure:
    figure, axes = _blank(WIDTH, FRAME_HEIGHT + MAP_HEIGHT * (len(chart.places) + 1))
    draw_map(axes, chart, COLOURS["first"], INK)
    if chart.under:
        axes.set_xlabel(fill(plain(chart.under), LETTERS), color=SOFT, loc="right")
    return figure


def _curves(chart: Chart, scale: Callable[[Axes], None]) -> Figure:
    """Values over places; published curves are dashed."""
    places, series = chart.places, chart.series
    figure, axes = _blank(WIDTH, LEVELS_HEIGHT)
    for own in series:
        shift = -ASIDE if own.colour == series[0].colour else ASIDE
        _curve(axes, own, {place: index + shift for index, place in enumerate(places)})
    axes.set_xticks(range(len(places)), list(map(plain, places)))
    axes.set_xlim(-0.4, len(places) - 0.6)
    axes.set_xlabel(plain(chart.axis))
    if chart.under:
        axes.set_title(fill(plain(chart.under), LETTERS), fontsize=8.5, color=SOFT)
    scale(axes)
    axes.yaxis.set_minor_locator(NullLocator())
    axes.grid(axis="y")
    axes.set_axisbelow(True)
    axes.spines["left"].set_visible(False)
    return figure


def _of_seconds(axes: Axes) -> None:
    axes.set_yscale("log", nonpositive="mask")
    axes.yaxis.set_major_formatter(FuncFormatter(lambda value, _: _seconds(value)))


def _of_shares(axes: Axes) -> None:
    axes.set_ylim(-0.03, 1.03)
    axes.set_yticks(*SHARES)


def _of_ratios(axes: Axes) -> None:
    axes.axhline(1.0, color=SOFT, linewidth=1.0, zorder=1)


def _of_numbers(axes: Axes) -> None:
    axes.set_ylim(bottom=0.0)


CURVES = {
    "seconds": _of_seconds,
    "share curve": _of_shares,
    "ratio curve": _of_ratios,
    "number curve": _of_numbers,
}
"""How the axis of values is drawn, by the kind of curves."""


def _dots(axes: Axes, series: Series, heights: dict[str, float]) -> None:
    for point in series.points:
        height = heights[point.place]
        if point.low is not None and point.high is not None:
            axes.plot([point.low, point.high], [height, height], color=COLOURS[series.colour])
        axes.plot([point.value], [height], **_look(series))


def _curve(axes: Axes, series: Series, places: dict[str, float]) -> None:
    x = [places[point.place] for point in series.points]
    y = [point.value for point in series.points]
    line, colour = (0, (3, 2)) if series.published else "-", COLOURS[series.colour]
    for at, point in zip(x, series.points, strict=True):
        if point.low is not None and point.high is not None:
            axes.plot([at, at], [point.low, point.high], color=colour, alpha=0.35, lw=3)
    axes.plot(x, y, color=colour, linestyle=line, zorder=3)
    for at, value in zip(x, y, strict=True):
        axes.plot([at], [value], **_look(series), zorder=4)


def _look(series: Series) -> dict[str, Any]:
    colour = COLOURS[series.colour]
    return {
        "marker": series.marker,
        "color": colour,
        "markerfacecolor": CARD if series.published else colour,
        "linestyle": "none",
    }


def _shares(axes: Axes) -> None:
    axes.set_xlim(-0.03, 1.03)
    axes.set_xticks(*SHARES)
    axes.grid(axis="x")


def _ratios(axes: Axes, series: Sequence[Series]) -> None:
    drawn = (end for own in series for p in own.points for end in (p.low, p.value, p.high))
    ends = [end for end in drawn if end is not None and end > 0]
    low, high = min(ends, default=1.0), max(ends, default=1.0)
    axes.set_xscale("log", nonpositive="mask")
    axes.set_xlim(min(low / ROOM, 0.8), max(high * ROOM, 1.25))
    axes.xaxis.set_major_locator(FixedLocator(TICKS))
    axes.xaxis.set_major_formatter(FuncFormatter(lambda value, _: f"{value:g}"))
    axes.xaxis.set_minor_locator(NullLocator())
    axes.grid(axis="x")
    axes.axvline(1.0, color=SOFT, linewidth=1.0, zorder=1)


def _seconds(value: float) -> str:
    return f"{1000 * value:g} ms" if value < 1 else f"{value:g} s"


def _blank(width: float, height: float) -> tuple[Figure, Axes]:
    """An empty figure of so many inches, with axes; to be made and drawn within `SETTINGS`."""
    figure = Figure(figsize=(width, height), layout="constrained")
    figure.patch.set_alpha(0.0)
    axes = figure.subplots()
    axes.patch.set_alpha(0.0)
    axes.tick_params(length=0)
    return figure, axes


def _inline(figure: Figure, name: str, label: str) -> Markup:
    """The figure as an `svg` element; `name` sets its ids apart, `label` says what it shows.

    Nothing is clipped, so that nothing refers to a part of it by address.
    """
    for artist in figure.findobj():
        artist.set_clip_on(False)
    buffer = io.StringIO()
    with mpl.rc_context({"svg.hashsalt": name}):
        figure.savefig(buffer, format="svg", metadata={"Date": None})
    return Markup(_tidied(buffer.getvalue(), name, label))


def _tidied(text: str, name: str, label: str) -> str:
    """Without what a file needs and a part of a page does not, and with the page's colours."""
    head, _, rest = text[text.index("<svg") :].partition(">")
    box = re.search(r'viewBox="[^"]+"', head)
    assert box is not None
    needless = r"<(metadata|style)\b.*?</\1>|<!--.*?-->|<\?.*?\?>"
    body = re.sub(needless, "", rest, flags=re.DOTALL).replace("xlink:href", "href")
    for colour, variable in VARIABLES.items():
        body = body.replace(colour, f"var({variable})")
    body = re.sub(r"font-family: [^;\"]+; ?", "", body)
    body = re.sub(r"\n\s*", "\n", _own_ids(body, name))
    return f'<svg {box.group()} role="img" aria-label="{escape(label)}">{body}'


def _own_ids(body: str, name: str) -> str:
    """Ids that something refers to are of this figure alone; the others are left out."""
    used = set(re.findall(r'href="#([^"]+)"', body))
    own_id = r' id="([^"]+)"'
    body = re.sub(own_id, lambda m: f' id="{name}-{m[1]}"' if m[1] in used else "", body)
    return re.sub(r'href="#', f'href="#{name}-', body)
