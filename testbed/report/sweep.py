"""What a sweep found: success and cost of each robot under each condition, with curves."""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from itertools import product
from typing import Any

import polars as pl

from testbed.analysis import Run
from testbed.analysis.bootstrap import Estimate, proportion, sample_of
from testbed.analysis.comparison import compared, eventful, measured, with_apart
from testbed.analysis.pairs import OTHER, Compared, Sample, pairs_of
from testbed.config.sweep import Axis
from testbed.experiment.timeline import in_words
from testbed.studies import Chart, Key, Point, Section, Series
from testbed.studies.tables import Cell, Line, View

LOOKS = (("first", "o"), ("second", "s"), ("first", "^"), ("second", "D"))
"""Colours and marks of robots, in the order in which they play."""
COSTS = ("execution_units", "actions")
"""What is compared where both achieve; units are none in a domain without costs."""
MOST_CURVES = 12
"""Figures of one measure: of more conditions the table has the numbers."""


@dataclass(frozen=True)
class Condition:
    """What the trials under one condition come to.

    `achieved`: by robot, the share of trials that achieve the goal, of those that count; `ratios`:
    by measure what the baseline needed divided by what the treatment did, over the pairs in which
    both achieved; `pairs`: how many count.
    """

    pairs: int
    achieved: Mapping[str, Estimate | None]
    ratios: Mapping[str, Estimate | None]


def conditions(run: Run) -> dict[str, Condition]:
    """By its name what each condition comes to, in the order of the sweep."""
    return {name: _condition(own) for name, own in run.conditions.items()}


def _condition(run: Run) -> Condition:
    main, *_ = compared(run.config)
    trials = with_apart(measured(run.trials), main, eventful(run.config))
    counted = trials.filter(pl.col("apart").is_null())
    both = Sample(pairs_of(counted, main)).where("achieved", "achieved" + OTHER).ended
    return Condition(
        counted["pair"].n_unique(),
        {name: _share(counted.filter(robot=name)) for name in run.config.robots},
        {name: both.ratio(name).mean for name in COSTS},
    )


def _share(trials: pl.DataFrame) -> Estimate | None:
    if not len(trials):
        return None
    return proportion(sample_of(trials["achieved"].to_numpy(), clusters=trials["state"].to_list()))


def numbers(run: Run) -> dict[str, Any]:
    """The part of `summary.json`: the keys of each condition, shares and ratio with intervals."""
    if not run.config.is_sweep:
        return {}
    cells = run.config.sweep.cells
    return {
        "conditions": {
            name: {
                "keys": cells[name],
                "pairs": own.pairs,
                "achieved": {robot: _ends(share) for robot, share in own.achieved.items()},
                "ratios": {measure: _ends(ratio) for measure, ratio in own.ratios.items()},
            }
            for name, own in conditions(run).items()
        }
    }


def _ends(own: Estimate | None) -> dict[str, float] | None:
    return None if own is None else {"value": own.value, "low": own.low, "high": own.high}


def sections(run: Run) -> list[Section]:
    """The part of a swept run in its report; none of a run without a sweep."""
    if not run.config.is_sweep:
        return []
    found, (main, *_) = conditions(run), compared(run.config)
    robots = run.config.robots[: len(LOOKS)]
    legend = [
        Key("interval" if mark == "o" else "square", colour, robot)  # type: ignore[arg-type]
        for robot, (colour, mark) in zip(robots, LOOKS, strict=False)
    ]
    return [
        Section(
            "conditions",
            "Under each condition",
            [_view(found, run.config.robots, main)],
            [*_charts(found, run.config.sweep.axes, robots, main)],
            legend,
        )
    ]


def _view(found: Mapping[str, Condition], robots: Sequence[str], main: Compared) -> View:
    columns = ("condition", "pairs", *(f"{name} achieved" for name in robots))
    costs = COSTS if main.baseline else ()
    divided = f"{main.baseline} / {main.treatment}, where both achieve"
    lines = [
        Line(
            (name, str(own.pairs)),
            (
                *(Cell(share, share=True).value for share in own.achieved.values()),
                *(Cell(own.ratios[measure]).value for measure in costs),
            ),
        )
        for name, own in found.items()
    ]
    return View(
        "conditions-table",
        "Success and cost by condition",
        (*columns, *(f"{in_words(measure)}, {divided}" for measure in costs)),
        lines,
    )


def _charts(
    found: Mapping[str, Condition], axes: Sequence[Axis], robots: Sequence[str], main: Compared
) -> Iterator[Chart]:
    """Curves over the last of the axes, one figure for each choice of the others."""
    *others, last = axes
    choices = list(product(*(axis.points for axis in others)))
    if len(choices) > MOST_CURVES:
        return
    places = [name.removeprefix(f"{last.name}=") for name in last.points]
    for number, choice in enumerate(choices):
        own = [found[", ".join([*choice, point])] for point in last.points]
        under = f", {', '.join(choice)}" if choice else ""
        shares = [
            Series(robot, colour, _points(places, [c.achieved[robot] for c in own]), mark)  # type: ignore[arg-type]
            for robot, (colour, mark) in zip(robots, LOOKS, strict=False)
        ]
        title = f"achieved, by {last.name}{under}"
        yield Chart(f"conditions-achieved-{number}", title, places, shares, "share curve")
        measured_by = {m: _points(places, [c.ratios[m] for c in own]) for m in COSTS}
        measure = next((m for m, points in measured_by.items() if points), None)
        if measure is not None:
            title = (
                f"{in_words(measure)}, {main.baseline} / {main.treatment}, by {last.name}{under}"
            )
            series = [Series("ratio", "first", measured_by[measure])]
            yield Chart(f"conditions-cost-{number}", title, places, series, "ratio curve")


def _points(places: Sequence[str], values: Sequence[Estimate | None]) -> tuple[Point, ...]:
    both = zip(places, values, strict=True)
    return tuple(Point(place, own.value, *own.ends) for place, own in both if own is not None)
