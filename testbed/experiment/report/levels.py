"""Tables 2 and 3 as the report shows them: seconds of reasoning by level, above the published."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from typing import Any

from testbed.experiment.levels.published import NO_ZOOM, PARTS, PUBLISHED, RATIOS, ZOOM
from testbed.experiment.levels.table import CONDITIONS
from testbed.experiment.report.figures import Panel, Point, Series, curves
from testbed.experiment.report.svg import FIRST, SECOND

COLUMNS = ("level", "reasoning", "achieved", "all", "fine", "coarse", "a refined plan")
TITLES = {
    "total": "all reasoning of a trial",
    "fine": "at the fine resolution",
    "coarse": "at the coarse resolution",
    "refined_plan": "one refined plan",
}
LOOKS = {ZOOM: (FIRST, "o"), NO_ZOOM: (SECOND, "s")}
LEAST = 0.1
RATIO = "no zoom / zoom"


@dataclass(frozen=True)
class Value:
    """A cell: ours and the published value, either of them "" where there is none."""

    ours: str
    published: str = ""


@dataclass(frozen=True)
class Line:
    """A row of the table; `first` of its level."""

    level: str
    reasoning: str
    first: bool
    values: tuple[Value, ...]


def lines(summary: Mapping[str, Any]) -> list[Line]:
    """The rows of the table: of each level its robots, and the ratio of both."""
    return [
        Line(level, reasoning, not number, values)
        for level, group in summary["levels"].items()
        if "reasoning" in group
        for number, (reasoning, values) in enumerate(_level(level, group))
    ]


def _level(level: str, group: Mapping[str, Any]) -> Iterator[tuple[str, tuple[Value, ...]]]:
    for robot, own in group["reasoning"].items():
        values = _achieved(level, robot, own), *(_time(level, robot, own, part) for part in PARTS)
        yield CONDITIONS.get(robot, robot), values
    ratios, theirs = group["zoom_ratios"], RATIOS.get(level, {})
    if any(ratio is not None for ratio in ratios.values()):
        yield RATIO, (Value(""), *(_ratio(ratios[part], theirs.get(part)) for part in PARTS))


def _achieved(level: str, robot: str, own: Mapping[str, Any]) -> Value:
    out = f", {own['out_of_reach']} out of reach" if own["out_of_reach"] else ""
    paper = PUBLISHED.get((level, robot))
    published = "" if paper is None else f"{paper.completed:.0%}"
    return Value(f"{own['achieved']}/{own['trials']}{out}", published)


def _time(level: str, robot: str, own: Mapping[str, Any], part: str) -> Value:
    spread, paper = own[part], PUBLISHED.get((level, robot))
    known = paper is not None and part in paper.seconds
    return Value(
        "-" if spread is None else _spread(spread["mean"], spread["sd"]),
        _spread(*paper.seconds[part]) if paper is not None and known else "",
    )


def _ratio(ours: float | None, theirs: float | None) -> Value:
    return Value("-" if ours is None else f"{ours:.2f}", "" if theirs is None else f"{theirs:.2f}")


def _spread(mean: float, deviation: float) -> str:
    """Seconds as text: in ms where they are few."""
    if mean < 0.1:
        return f"{1000 * mean:.1f} ± {1000 * deviation:.1f} ms"
    return f"{mean:.2f} ± {deviation:.2f} s"


def panels(summary: Mapping[str, Any]) -> list[Panel]:
    """A figure for each part of the time; none where no level was played."""
    levels = {
        name: group["reasoning"]
        for name, group in summary["levels"].items()
        if "reasoning" in group
    }
    if not levels:
        return []
    return [
        curves(f"levels-{part}", TITLES[part], list(levels), list(_series(levels, part)))
        for part in PARTS
    ]


def _series(levels: Mapping[str, Any], part: str) -> Iterator[Series]:
    for robot, (colour, marker) in LOOKS.items():
        label = CONDITIONS[robot]
        ours = tuple(_ours(levels, robot, part))
        theirs = tuple(_theirs(levels, robot, part))
        yield from [Series(label, colour, ours, marker)] * bool(ours)
        yield from [Series(f"{label}, published", colour, theirs, marker, True)] * bool(theirs)


def _ours(levels: Mapping[str, Any], robot: str, part: str) -> Iterator[Point]:
    for level, robots in levels.items():
        spread = robots.get(robot, {}).get(part)
        if spread is not None and spread["mean"] > 0:
            yield _point(level, spread["mean"], spread["sd"])


def _theirs(levels: Mapping[str, Any], robot: str, part: str) -> Iterator[Point]:
    for level in levels:
        paper = PUBLISHED.get((level, robot))
        if paper is not None and part in paper.seconds:
            yield _point(level, *paper.seconds[part])


def _point(level: str, mean: float, deviation: float) -> Point:
    """A deviation beyond zero ends at a tenth of the mean: the scale is logarithmic."""
    return Point(level, mean, max(mean - deviation, LEAST * mean), mean + deviation)
