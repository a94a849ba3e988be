"""Figures of matplotlib as SVG that stands inside of a page and takes its colours from there."""

from __future__ import annotations

import io
import re
from collections.abc import Mapping
from typing import Any

import matplotlib as mpl
from markupsafe import Markup, escape
from matplotlib.axes import Axes
from matplotlib.figure import Figure

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
    "axes.edgecolor": LINE,
    "axes.labelcolor": SOFT,
    "axes.spines.top": False,
    "axes.spines.right": False,
    "xtick.color": SOFT,
    "ytick.color": SOFT,
    "xtick.labelcolor": SOFT,
    "ytick.labelcolor": INK,
    "grid.color": LINE,
    "grid.linewidth": 0.6,
    "lines.linewidth": 1.4,
    "lines.markersize": 4.5,
}
_FAMILY = re.compile(r"font-family: [^;\"]+; ?")
_IDS = re.compile(r' id="([^"]+)"')


def blank(width: float, height: float) -> tuple[Figure, Axes]:
    """An empty figure of so many inches, with axes; to be made and drawn within `SETTINGS`."""
    figure = Figure(figsize=(width, height), layout="constrained")
    figure.patch.set_alpha(0.0)
    axes = figure.subplots()
    axes.patch.set_alpha(0.0)
    axes.tick_params(length=0)
    return figure, axes


def inline(figure: Figure, name: str, label: str) -> Markup:
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
    body = re.sub(r"<(metadata|style)\b.*?</\1>", "", rest, flags=re.DOTALL)
    body = re.sub(r"<!--.*?-->|<\?.*?\?>", "", body, flags=re.DOTALL)
    body = body.replace("xlink:href", "href")
    for colour, variable in VARIABLES.items():
        body = body.replace(colour, f"var({variable})")
    body = re.sub(r"\n\s*", "\n", _own_ids(_FAMILY.sub("", body), name))
    return f'<svg {box.group()} role="img" aria-label="{escape(label)}">{body}'


def _own_ids(body: str, name: str) -> str:
    """Ids that something refers to are of this figure alone; the others are left out."""
    used = set(re.findall(r'href="#([^"]+)"', body))
    body = _IDS.sub(lambda m: f' id="{name}-{m[1]}"' if m[1] in used else "", body)
    return re.sub(r'href="#', f'href="#{name}-', body)
