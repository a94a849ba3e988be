"""Figures of Tables 2 and 3: seconds over the levels, and the ratios that zooming is about."""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from testbed.report import svg
from testbed.report.figures import Panel, Point, Series, curves, estimated, forest
from testbed.studies.levels import comparing
from testbed.studies.levels.comparing import CONDITIONS, RATIO, Levels
from testbed.studies.levels.published import NO_ZOOM, PARTS, ZOOM, Paper
from testbed.studies.levels.results import Spread

TITLES = {
    "total": "all reasoning of a trial",
    "fine": "at the fine resolution",
    "coarse": "at the coarse resolution",
    "refined_plan": "one refined plan",
}
LOOKS = {ZOOM: (svg.FIRST, "o"), NO_ZOOM: (svg.SECOND, "s")}
LEAST = 0.1


def panels(levels: Levels, paper: Paper) -> list[Panel]:
    """A figure for each part of the time; none where no level was played."""
    if not levels:
        return []
    return [
        curves(f"levels-{part}", TITLES[part], list(levels), list(_series(levels, paper, part)))
        for part in PARTS
    ]


def ratio_panels(levels: Levels, paper: Paper) -> list[Panel]:
    """A figure for each of the ratios that zooming is about; none where no pair was played."""
    lines = list(comparing.ratios(levels, paper))
    if not lines:
        return []
    rows = [line.level for line in lines]
    return [
        forest(f"levels-ratio-{part}", f"{RATIO}, {TITLES[part]}", rows, _compared(lines, part))
        for part in ("total", "refined_plan")
    ]


def _compared(lines: Iterable[comparing.Line], part: str) -> list[Series]:
    cells = [(line.level, line.cells[PARTS.index(part)]) for line in lines]
    ours = tuple(estimated(name, cell.ours) for name, cell in cells if cell.ours)
    theirs = tuple(Point(n, c.published.value) for n, c in cells if c.published)
    return [
        Series(RATIO, svg.SECOND, ours, "s"),
        *[Series("published", svg.PAPER, theirs, "D", True)] * bool(theirs),
    ]


def _series(levels: Levels, paper: Paper, part: str) -> Iterator[Series]:
    for robot, (colour, marker) in LOOKS.items():
        label = CONDITIONS[robot]
        ours = tuple(_ours(levels, robot, part))
        theirs = tuple(_theirs(levels, paper, robot, part))
        yield from [Series(label, colour, ours, marker)] * bool(ours)
        yield from [Series(f"{label}, published", colour, theirs, marker, True)] * bool(theirs)


def _ours(levels: Levels, robot: str, part: str) -> Iterator[Point]:
    for name, level in levels.items():
        own = level.reasoning.get(robot)
        found: Spread | None = None if own is None else getattr(own, part)
        if found is not None and found.mean > 0:
            yield _point(name, found.mean, found.sd)


def _theirs(levels: Levels, paper: Paper, robot: str, part: str) -> Iterator[Point]:
    for name in levels:
        known = paper.seconds(name, robot, part)
        if known is not None:
            yield _point(name, *known)


def _point(level: str, mean: float, deviation: float) -> Point:
    """A deviation beyond zero ends at a tenth of the mean: the scale is logarithmic."""
    return Point(level, mean, max(mean - deviation, LEAST * mean), mean + deviation)
