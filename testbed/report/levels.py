"""Tables 2 and 3 as the report shows them: ours with intervals, above the published figures."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass

from testbed.studies.levels import comparing
from testbed.studies.levels.comparing import Cell, Levels
from testbed.studies.levels.published import FIRST, PARTS, Paper
from testbed.studies.levels.results import Spread
from testbed.studies.levels.table import (
    GROWTH,
    HEADINGS,
    RATIOS,
    TESTS,
    effect_rows,
    out_of_reach,
    seconds,
    spread,
)

__all__ = ["TESTS", "Line", "Value", "View", "effect_rows", "views"]

REASONING = ("level", "reasoning", "trials", "achieved", *HEADINGS)


@dataclass(frozen=True)
class Value:
    """A cell: ours, its interval (of a time its deviation), its median, and the published value.

    `inside`: whether our interval holds that; None where it is not asked.
    """

    ours: str
    interval: str = ""
    median: str = ""
    published: str = ""
    inside: bool | None = None


@dataclass(frozen=True)
class Line:
    """A row of a table; `first` of its level."""

    level: str
    reasoning: str
    number: str
    first: bool
    values: tuple[Value, ...]


@dataclass(frozen=True)
class View:
    """A table: its name in the page, its title, what it says, its columns and rows."""

    name: str
    title: str
    note: str
    columns: tuple[str, ...]
    lines: tuple[Line, ...]


def views(levels: Levels, paper: Paper) -> list[View]:
    """The tables of a run, those without rows left out."""
    found = [
        View(
            "levels-seconds",
            "Trials that achieved their goal, and seconds",
            "Shares with their intervals, exact ones where all trials ended alike; means and "
            "standard deviations of times.",
            REASONING,
            tuple(_seconds(levels, paper)),
        ),
        View(
            "levels-ratios",
            "No zoom / zoom",
            _about_ratios(levels, paper),
            RATIOS,
            _lines(comparing.ratios(levels, paper)),
        ),
        View(
            "levels-growth",
            f"Growth from {FIRST}",
            f"How many times the mean at {FIRST} in the same condition the mean at a level is.",
            GROWTH,
            _lines(comparing.growth(levels, paper)),
        ),
    ]
    return [view for view in found if view.lines]


def _about_ratios(levels: Levels, paper: Paper) -> str:
    about = "Means over the pairs in which both achieved the goal; above 1 zooming saved time."
    few = comparing.has_few(comparing.ratios(levels, paper))
    return f"{about} Here are {comparing.FEW_PAIRS}." if few else about


def _lines(lines: Iterable[comparing.Line]) -> tuple[Line, ...]:
    found: list[Line] = []
    for line in lines:
        first = not found or found[-1].level != line.level
        values = tuple(_value(cell, "{:.2f}", "{:.2f}") for cell in line.cells)
        found.append(Line(line.level, line.what, str(line.number), first, values))
    return tuple(found)


def _value(cell: Cell, form: str, theirs: str) -> Value:
    published = "" if cell.published is None else theirs.format(cell.published.value)
    if cell.ours is None:
        return Value("-", published=published)
    median = "" if cell.median is None else form.format(cell.median.value)
    ends = f"{form.format(cell.ours.low)} to {form.format(cell.ours.high)}"
    interval = "" if cell.ours.single else ends
    return Value(form.format(cell.ours.value), interval, median, published, cell.inside)


def _seconds(levels: Levels, paper: Paper) -> Iterator[Line]:
    """The lines of the shares have the same order: by level and condition."""
    before = None
    for line in comparing.shares(levels, paper):
        own = levels[line.level].reasoning[line.robot]
        times = (_time(getattr(own, p), paper.seconds(line.level, line.robot, p)) for p in PARTS)
        (share,) = (_value(cell, "{:.1%}", "{:.0%}") for cell in line.cells)
        number = f"{own.trials}{out_of_reach(own)}"
        yield Line(line.level, line.what, number, line.level != before, (share, *times))
        before = line.level


def _time(own: Spread | None, theirs: tuple[float, float] | None) -> Value:
    published = "" if theirs is None else spread(*theirs)
    if own is None:
        return Value("-", published=published)
    return Value(spread(own.mean, own.sd), median=seconds(own.median), published=published)
