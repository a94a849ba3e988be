"""Studies of sweeps: what each condition comes to, as a table, as curves, and in the summary."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from itertools import product
from pathlib import Path
from typing import TYPE_CHECKING, Any

from testbed.analysis.pairs import Compared
from testbed.studies.charts import Chart, Colour, Key, Measure, Point, Series
from testbed.studies.explanations import EXPLANATIONS, sheet
from testbed.studies.study import Section, Study
from testbed.studies.tables import Cell, Line, Value, View

if TYPE_CHECKING:  # which loads polars
    from testbed.analysis import Run
    from testbed.analysis.bootstrap import Estimate
    from testbed.config.sweep import Axis

LOOKS: Sequence[tuple[Colour, str]] = (
    ("first", "o"),
    ("second", "s"),
    ("first", "^"),
    ("second", "D"),
)
"""Colours and marks of robots, in the order in which a configuration names them."""
MOST_CURVES = 12
"""Figures of one measure: of more conditions the table has the numbers."""


MEASURES: Mapping[str, Measure] = {
    "achieved": Measure("goal achieved", "share curve"),
    "actions": Measure("actions where achieved", "number curve", 1),
    "explanations": Measure("explanations", "number curve"),
    "reasoning": Measure("reasoning in ms", "number curve", 1),
    **EXPLANATIONS,
}
"""What is told of any sweep, by name; the values are those of `testbed.analysis.conditions`."""
COST = "cost"
"""The name of the ratio of costs: of the baseline to the treatment, where both achieve."""


@dataclass(frozen=True)
class Found:
    """What a swept run comes to: its axes, robots, and by condition estimates.

    `robots`: by measure and robot; `cost`: the ratio of the costs, None without a baseline;
    `pairs`: how many count; `both`: in how many of them both achieve.
    """

    axes: Sequence[Axis]
    names: Sequence[str]
    compared: Compared
    keys: Mapping[str, Mapping[str, Any]]
    pairs: Mapping[str, int]
    both: Mapping[str, int]
    robots: Mapping[str, Mapping[str, Mapping[str, Estimate | None]]]
    cost: Mapping[str, Estimate | None]


def sweep_study(
    measures: Sequence[str], title: str, template: Path | None = None, fine: bool = False
) -> Study[Found]:
    """A study of a sweep that tells these of `MEASURES`, and the ratio of costs."""
    return Study(
        measures=lambda run, _: found_in(run) if run.config.is_sweep else None,
        numbers=numbers,
        sections=lambda found: [_section(found, measures, title, template)],
        fine=fine,
    )


def found_in(run: Run, measures: Sequence[str] = tuple(MEASURES)) -> Found:
    """What each condition of a run comes to, by these measures."""
    from testbed.analysis.conditions import estimates  # noqa: PLC0415  # which loads polars

    compared, by_condition = estimates(run, measures)
    return Found(
        run.config.sweep.axes,
        run.config.robots,
        compared,
        run.config.sweep.cells,
        {name: own.pairs for name, own in by_condition.items()},
        {name: own.both for name, own in by_condition.items()},
        {name: own.robots for name, own in by_condition.items()},
        {name: own.cost for name, own in by_condition.items()},
    )


def numbers(found: Found) -> dict[str, Any]:
    """The part of `summary.json`: of each condition its keys, and estimates with intervals."""
    return {
        "conditions": {
            name: {
                "keys": keys,
                "pairs": found.pairs[name],
                "both_achieve": found.both[name],
                **{
                    measure: {robot: _ends(value) for robot, value in own.items()}
                    for measure, own in found.robots[name].items()
                },
                COST: _ends(found.cost[name]),
            }
            for name, keys in found.keys.items()
        }
    }


def _ends(own: Estimate | None) -> dict[str, float | None] | None:
    return None if own is None else own.numbers


def _section(found: Found, measures: Sequence[str], title: str, template: Path | None) -> Section:
    looks = list(zip(found.names, LOOKS, strict=False))
    legend = [
        Key("interval" if m == "o" else "square", colour, name) for name, (colour, m) in looks
    ]
    charts = [
        *(chart for measure in measures for chart in _curves(found, measure)),
        *_cost_curves(found),
    ]
    explained = sheet(found.robots, found.names)
    sheets = [] if explained is None else [explained]
    return Section("conditions", title, [_view(found, measures)], charts, legend, sheets, template)


def _view(found: Found, measures: Sequence[str]) -> View:
    """One line per condition: each measure of each robot, and the ratio of costs."""
    divided = f"actions, {found.compared.baseline} / {found.compared.treatment}, where both achieve"
    columns = [f"{name}: {MEASURES[measure].title}" for measure in measures for name in found.names]
    lines = [
        Line(
            (condition, str(found.pairs[condition])),
            (
                *(MEASURES[m].value(own[m][name]) for m in measures for name in found.names),
                *(_cost(found, condition) if found.compared.baseline else ()),
            ),
        )
        for condition, own in found.robots.items()
    ]
    return View(
        "conditions-table",
        "By condition",
        (
            "condition",
            "pairs",
            *columns,
            *(["both achieve", divided] if found.compared.baseline else []),
        ),
        lines,
    )


def _cost(found: Found, condition: str) -> tuple[Value, Value]:
    """In how many pairs both achieve, and the ratio of costs over these."""
    return Value(str(found.both[condition])), Cell(found.cost[condition]).value


def _curves(found: Found, measure: str) -> Iterator[Chart]:
    """A figure of a measure for each choice of the other axes, with a curve per robot."""
    own = MEASURES[measure]
    for number, (axis, under, places, conditions) in enumerate(_choices(found)):
        series = [
            Series(
                name,
                colour,
                _points(places, [found.robots[c][measure][name] for c in conditions]),
                m,
            )
            for name, (colour, m) in zip(found.names, LOOKS, strict=False)
        ]
        yield Chart(f"{measure}-{number}", own.title, places, series, own.kind, axis, under)


def _cost_curves(found: Found) -> Iterator[Chart]:
    """The same of the ratio of costs, where there is one."""
    title = f"actions, {found.compared.baseline} / {found.compared.treatment}"
    for number, (axis, under, places, conditions) in enumerate(_choices(found)):
        points = _points(places, [found.cost[condition] for condition in conditions])
        if points:
            series = [Series("ratio", "first", points)]
            yield Chart(f"{COST}-{number}", title, places, series, "ratio curve", axis, under)


def _choices(found: Found) -> Iterator[tuple[str, str, list[str], list[str]]]:
    """For each choice of the other axes: the last axis, the choice, the places, the conditions."""
    *others, last = found.axes
    choices = list(product(*(axis.points for axis in others)))
    if len(choices) <= MOST_CURVES:
        places = [name.removeprefix(f"{last.name}=") for name in last.points]
        for choice in choices:
            conditions = [", ".join([*choice, point]) for point in last.points]
            yield _short(last.name), ", ".join(map(_short, choice)), places, conditions


def _short(key: str) -> str:
    """The last part of a key, with its value if any: `delay=3` of `observability.f.delay=3`."""
    name, equals, value = key.partition("=")
    return name.rpartition(".")[2] + equals + value


def _points(places: Sequence[str], values: Sequence[Estimate | None]) -> tuple[Point, ...]:
    both = zip(places, values, strict=True)
    return tuple(Point(place, own.value, *own.ends) for place, own in both if own is not None)


SWEEP = sweep_study(("achieved",), "Under each condition")
"""What is told of a sweep whose configuration names no study."""
