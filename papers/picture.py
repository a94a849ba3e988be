"""The figures of a run as one SVG file for a page elsewhere, in light and in dark."""

import re
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path

from markupsafe import Markup

from testbed.analysis import load_run
from testbed.experiment import StoreError
from testbed.report.figures import Panel, drawn
from testbed.report.page import environment
from testbed.studies import Key, Section, results_of

COLUMNS = 4
CARD, GAP, HEAD, LEGEND = 292, 12, 32, 34
MARK, LETTER = 60, 7
"""Widths in a legend: of a mark with the space beside it, and of a letter."""
CURVES = ("line", "line square", "dashed")
"""Marks of curves."""
_BOX = re.compile(r'<svg viewBox="0 0 ([\d.]+) ([\d.]+)"')


@dataclass(frozen=True)
class Entry:
    """An entry of the legend, at its place."""

    kind: str
    colour: str
    text: str
    x: int
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


def picture(folder: Path) -> str:
    """The figures of a run of a study, as the text of an SVG file.

    Raises:
        StoreError: for a folder without a run, or one without such figures.
        ConfigError: where the stored configuration is not valid any more.
    """
    found = results_of(load_run(folder))
    sections = [own for finding in found for own in finding.sections if own.charts]
    if not sections:
        raise StoreError(f"{folder}: has no figures; only published experiments have")
    return _drawn(sections[0])


def _drawn(section: Section) -> str:
    """The charts of a section that are like its first, which are equally large."""
    curves = section.charts[0].kind == "seconds"
    charts = [own for own in section.charts if (own.kind == "seconds") == curves]
    keys = [own for own in section.legend if (own.mark in CURVES) == curves]
    places = list(_places(list(map(drawn, charts))))
    return (
        environment()
        .get_template("picture.svg.j2")
        .render(
            label=section.title,
            keys=list(_legend(keys)),
            places=places,
            width=GAP + COLUMNS * (CARD + GAP),
            height=max(place.y + place.height for place in places) + GAP,
        )
    )


def _legend(keys: Sequence[Key]) -> Iterator[Entry]:
    x = GAP
    for key in keys:
        yield Entry(key.mark, key.colour, key.text, x)
        x += MARK + LETTER * len(key.text)


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
