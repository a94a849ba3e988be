"""The figures of a run as one SVG file for a page elsewhere, in light and in dark."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path

from markupsafe import Markup

from testbed.analysis.summary import summarise
from testbed.experiment.errors import StoreError
from testbed.experiment.store import read_config, read_records
from testbed.report import level_panels, table1
from testbed.report.figures import Panel
from testbed.report.rendering import environment
from testbed.studies.levels.protocol import paper_of
from testbed.studies.levels.results import levels_of

COLUMNS = 4
CARD, GAP, HEAD, LEGEND = 292, 12, 32, 34
_BOX = re.compile(r'<svg viewBox="0 0 ([\d.]+) ([\d.]+)"')


@dataclass(frozen=True)
class Key:
    """An entry of the legend, at its place."""

    kind: str
    colour: str
    text: str
    x: int = GAP
    y: int = GAP


@dataclass(frozen=True)
class Placed:
    """A panel on its card."""

    title: str
    svg: Markup
    x: int
    y: int
    width: int
    height: int


TABLE1_KEYS = (
    Key("interval", "first", "triggered, with 95% interval"),
    Key("square", "second", "drawn at random, classified by what happened", x=240),
    Key("published", "paper", "published", x=590),
)
LEVEL_KEYS = (
    Key("line", "first", "zoom, with standard deviation"),
    Key("line square", "second", "no zoom", x=260),
    Key("dashed", "paper", "published", x=370),
)


def picture(folder: Path) -> str:
    """The figures of a run of a published experiment, as the text of an SVG file.

    Raises:
        StoreError: for a folder without a run, or one without such figures.
        ConfigError: where the stored configuration is not valid any more.
    """
    config = read_config(folder)
    analyses = table1.analyses(folder, config)
    if analyses:
        label = "Table 1: accuracy and ratios by scenario"
        return _drawn(table1.panels(analyses[0]), TABLE1_KEYS, label)
    panels = level_panels.panels(levels_of(summarise(read_records(folder))), paper_of(config))
    if not panels:
        raise StoreError(f"{folder}: has no figures; only published experiments have")
    return _drawn(panels, LEVEL_KEYS, "Reasoning time by level, zoom and no zoom")


def _drawn(panels: Sequence[Panel], keys: Sequence[Key], label: str) -> str:
    places = list(_places(panels))
    return (
        environment()
        .get_template("picture.svg.j2")
        .render(
            label=label,
            keys=keys,
            places=places,
            width=GAP + COLUMNS * (CARD + GAP),
            height=max(place.y + place.height for place in places) + GAP,
        )
    )


def _places(panels: Sequence[Panel]) -> Iterator[Placed]:
    """Cards in rows; panels of one picture are equally large."""
    for number, panel in enumerate(panels):
        box = _BOX.match(panel.svg)
        assert box is not None
        inner = CARD - 2 * GAP
        high = round(inner * float(box[2]) / float(box[1]))
        sized = f'<svg x="{GAP}" y="{HEAD}" width="{inner}" height="{high}" viewBox='
        row, column = divmod(number, COLUMNS)
        yield Placed(
            title=panel.title,
            svg=Markup(str(panel.svg).replace("<svg viewBox=", sized, 1)),
            x=GAP + column * (CARD + GAP),
            y=GAP + LEGEND + row * (HEAD + high + GAP + GAP),
            width=CARD,
            height=HEAD + high + GAP,
        )
