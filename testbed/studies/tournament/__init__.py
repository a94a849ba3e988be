"""Robots against adversaries: failures, extra units, regret and plans, by adversary and robot."""

from collections.abc import Iterator, Mapping
from itertools import product
from pathlib import Path
from typing import TYPE_CHECKING

from testbed.studies.charts import Chart, HeatKind, Measure, Point, Series
from testbed.studies.study import Section, Study
from testbed.studies.sweeps import MEASURES as COMMON
from testbed.studies.sweeps import Found, found_in, numbers
from testbed.studies.tables import Line, View

if TYPE_CHECKING:  # which loads polars
    from testbed.analysis import Run

MEASURES: Mapping[str, Measure] = {
    "achieved": COMMON["achieved"],
    "extra": Measure("extra units where achieved", "number curve", 1),
    "regret": Measure("regret in units where achieved", "number curve", 1),
    "plans": Measure("plans", "number curve", 1),
}
"""By name; the values are those of `testbed.analysis.conditions`."""


def measures(run: "Run", _as_published: bool) -> Found | None:
    """What each condition of a sweep comes to."""
    return found_in(run, (*COMMON, *MEASURES)) if run.config.is_sweep else None


def sections(found: Found) -> list[Section]:
    """A table per measure, and for each choice of the other axes a map of adversaries and robots.

    The adversaries are the points of the first axis.
    """
    views = [_view(found, name) for name in MEASURES]
    charts = [chart for name in MEASURES for chart in _maps(found, name)]
    template = Path(__file__).with_name("section.html.j2")
    return [Section("tournament", "Robots against adversaries", views, charts, template=template)]


def _view(found: Found, name: str) -> View:
    """One line per condition, one column per robot."""
    own = MEASURES[name]
    lines = [
        Line(
            (condition, str(found.pairs[condition])),
            tuple(own.value(by_measure[name][robot]) for robot in found.names),
        )
        for condition, by_measure in found.robots.items()
    ]
    columns = ("condition", "pairs", *found.names)
    return View(f"tournament-{name}", own.title.capitalize(), columns, lines)


def _maps(found: Found, name: str) -> Iterator[Chart]:
    adversaries, *others = (axis.points for axis in found.axes)
    own = MEASURES[name]
    kind: HeatKind = "share heat" if own.kind == "share curve" else "number heat"
    for number, choice in enumerate(product(*others)):
        conditions = {place: ", ".join([place, *choice]) for place in adversaries}
        series = [_column(found, conditions, name, robot) for robot in found.names]
        under = ", ".join(choice)
        yield Chart(f"{name}-{number}", own.title, [*adversaries], series, kind, under=under)


def _column(found: Found, conditions: Mapping[str, str], name: str, robot: str) -> Series:
    estimates = ((at, found.robots[own][name][robot]) for at, own in conditions.items())
    points = tuple(Point(at, own.value, *own.ends) for at, own in estimates if own is not None)
    return Series(robot, "first", points)


STUDY: Study[Found] = Study(measures=measures, numbers=numbers, sections=sections)
