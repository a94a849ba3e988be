"""What a study has drawn: values with intervals by row, or as curves."""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from typing import Literal, NamedTuple

from testbed.analysis.bootstrap import Estimate
from testbed.studies.tables import Cell, Value

Colour = Literal["first", "second", "paper"]
CurveKind = Literal["seconds", "share curve", "ratio curve", "number curve"]
"""Curves: seconds on a log scale, shares of a whole, ratios around 1, numbers from 0 on."""
HeatKind = Literal["share heat", "number heat"]
"""Maps of shares of a whole, or of numbers, of each place (a row) and series (a column)."""


@dataclass(frozen=True)
class Measure:
    """What is estimated of a robot's trials under a condition: its title, and how it is drawn."""

    title: str
    kind: CurveKind
    digits: int = 2

    def value(self, own: Estimate | None) -> Value:
        """An estimate of it as text."""
        if own is None or self.kind == "share curve":
            return Cell(own, share=True).value
        ours, *ends = (f"{each:.{self.digits}f}" for each in (own.value, *own.ends))
        return Value(ours, tuple(ends))


class Key(NamedTuple):
    """An entry of a legend: the kind of a mark, its colour, and what it stands for."""

    mark: Literal["interval", "square", "published", "line", "line square", "dashed"]
    colour: Colour
    text: str


@dataclass(frozen=True)
class Point:
    """A value in a row (or at a level), with the ends of its interval where it has one."""

    place: str
    value: float
    low: float | None = None
    high: float | None = None


@dataclass(frozen=True)
class Series:
    """Points that belong together. Published ones are hollow."""

    label: str
    colour: Colour
    points: tuple[Point, ...]
    marker: str = "o"
    published: bool = False


@dataclass(frozen=True)
class Chart:
    """A figure of its own.

    One row per place with `ratios` around 1, or `shares`; or curves over the places, with the name
    of what they are values of (`axis`), and what holds in this figure alone (`under`); or a map of
    places and series, the darker the larger the value.
    """

    name: str
    title: str
    places: Sequence[str]
    series: Sequence[Series]
    kind: Literal["ratios", "shares"] | CurveKind | HeatKind = "ratios"
    axis: str = ""
    under: str = ""


def points(estimates: Iterable[tuple[str, Estimate | None]]) -> tuple[Point, ...]:
    """A point for each estimate that there is; one that is single has no interval."""
    return tuple(Point(at, own.value, *own.ends) for at, own in estimates if own is not None)


def published(values: Iterable[tuple[str, float]]) -> list[Series]:
    """The series of published values; none without any."""
    own = tuple(Point(place, value) for place, value in values)
    return [Series("published", "paper", own, "D", published=True)] if own else []
