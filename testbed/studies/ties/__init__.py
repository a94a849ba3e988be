"""How success depends on which of several equally small explanations a robot adopts."""

from collections.abc import Iterator, Sequence
from dataclasses import replace
from itertools import product
from pathlib import Path

from testbed.studies.charts import Chart, Key, Point, Series
from testbed.studies.study import Section, Study
from testbed.studies.sweeps import LOOKS, Found, sweep_study

_SWEEP: Study[Found] = sweep_study(
    ("achieved", "actions", "explanations"),
    "Success by the order of equally small explanations",
    Path(__file__).with_name("section.html.j2"),
)


def sections(found: Found) -> list[Section]:
    """The part of the sweep; its figure is how the shares of a robot are distributed."""
    series = list(_series(found))
    spread = Chart("orders", "goal achieved, a point per order", found.names, series, "shares")
    legend = [Key("square" if s.marker == "s" else "interval", s.colour, s.label) for s in series]
    return [replace(own, charts=[spread], legend=legend) for own in _SWEEP.sections(found)]


def _series(found: Found) -> Iterator[Series]:
    """For each choice of the other axes the shares of the robots under all orders."""
    *others, orders = found.axes
    choices = product(*(axis.points for axis in others))
    for choice, (colour, mark) in zip(choices, LOOKS, strict=False):
        names = [", ".join([*choice, order]) for order in orders.points]
        points = tuple(point for name in names for point in _shares(found, name))
        yield Series(", ".join(choice) or "all", colour, points, mark)


def _shares(found: Found, condition: str) -> Sequence[Point]:
    shares = found.robots[condition]["achieved"].items()
    return [Point(robot, own.value) for robot, own in shares if own is not None]


STUDY: Study[Found] = replace(_SWEEP, sections=sections)
