"""How two robots compare in each scenario of a run: as a table, and as charts with intervals."""

from collections.abc import Callable, Mapping
from functools import partial
from typing import Any

import polars as pl

from testbed.analysis.bootstrap import Estimate
from testbed.analysis.comparison import LEAST, MEASURES
from testbed.analysis.pairs import OTHER, Compared, Sample, pairs_of
from testbed.experiment.record import COARSE
from testbed.experiment.timeline import in_words
from testbed.studies import Chart, Point, Series, points
from testbed.text import number

OPTIMUM = ("robot", "trials", *(in_words(measure) for measure in LEAST))
ENOUGH = 2
"""Pairs from which on an interval says something."""


def groups_of(summary: Mapping[str, Any]) -> dict[str, Any]:
    """The scenarios of a summary, then all of them; none where not both robots played."""
    groups = dict(summary["scenarios"])
    if len(groups) > 1:
        levels = summary["levels"]
        groups |= {"all" if len(levels) == 1 else f"all, {name}": levels[name] for name in levels}
    robots = {summary["treatment"], summary["baseline"]}
    return groups if any(robots <= set(own["accuracy"]) for own in groups.values()) else {}


def optima(summary: Mapping[str, Any]) -> list[tuple[str, ...]]:
    """How far each robot is from the least that achieves the goal: scenario or level, OPTIMUM."""
    levels = [name for name in summary["levels"] if name != COARSE]
    groups = summary["levels" if levels else "scenarios"].items()
    return [
        (name, robot, str(own["trials"]), *(number(own[measure]) for measure in LEAST))
        for name, group in groups
        for robot, own in sorted(group["optimum"].items())
        if own["trials"]
    ]


def charts(trials: pl.DataFrame, summary: Mapping[str, Any]) -> list[Chart]:
    """The accuracies and each ratio by scenario or level; none without pairs to compare.

    `trials` are those of the main comparison, with the column `apart`. Of the scenarios that the
    summary says are `exhaustive` there are no intervals.
    """
    robots = Compared(summary["baseline"], summary["treatment"])
    where = pl.when(pl.col("level") == COARSE).then("scenario").otherwise("level")
    pairs = pairs_of(trials.filter(pl.col("apart").is_null()), robots).with_columns(place=where)
    groups = {
        str(name): Sample(own, whole=name in summary["exhaustive"])
        for (name,), own in pairs.partition_by("place", as_dict=True).items()
        if len(own) >= ENOUGH
    }
    if not groups:
        return []

    def drawn(estimate: Callable[[Sample], Estimate | None]) -> tuple[Point, ...]:
        return points((name, estimate(own)) for name, own in groups.items())

    shares = [
        Series(robots.treatment, "first", drawn(lambda own: own.share("correct" + OTHER))),
        Series(robots.baseline, "second", drawn(lambda own: own.share("correct")), "s"),
    ]
    divided = f"{robots.baseline} / {robots.treatment}"
    ratios = {name: Series("ratio", "first", drawn(partial(_mean, name))) for name in MEASURES}
    return [
        Chart("compared-correct", "correct", list(groups), shares, "shares"),
        *(
            Chart(f"compared-{name}", f"{in_words(name)}, {divided}", list(groups), [own])
            for name, own in ratios.items()
        ),
    ]


def _mean(measure: str, sample: Sample) -> Estimate | None:
    above, below = pl.col(measure), pl.col(measure + OTHER)
    return sample.achieved.where(below != 0).mean(above / below)
