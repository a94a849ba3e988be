"""How two robots compare in each scenario of a run: as a table, and as charts with intervals."""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterable, Iterator, Mapping
from dataclasses import dataclass
from functools import partial
from typing import Any

from testbed.analysis.counting import BASELINE, INTENTIONAL
from testbed.analysis.optimum import COMPARED
from testbed.analysis.outline import MEASURES, Outline
from testbed.analysis.pairwise import ACCURACY, COUNTS
from testbed.analysis.statistics import Estimate
from testbed.experiment.record import COARSE, TrialRecord
from testbed.experiment.wording import chance, in_words, place
from testbed.studies import Chart, Colour, Sample, Series, joined, points

ROBOTS = (INTENTIONAL, BASELINE)
OPTIMUM = ("robot", "trials", *(in_words(measure) for measure in COMPARED))
LEAST = 2
"""Pairs from which on a test, or an interval, says something."""
Pair = tuple[Outline, Outline]
"""The trial of the first robot, and that of the second."""


@dataclass(frozen=True)
class Cell:
    """A value; below it how large the difference is, and how likely by chance, if anything differs.

    Below the number of pairs: how many are counted apart, and why.
    """

    label: str
    value: str
    note: str = ""


@dataclass(frozen=True)
class Comparison:
    """The cells of one scenario, "all" for all of them."""

    scenario: str
    cells: tuple[Cell, ...]


def comparisons(summary: Mapping[str, Any]) -> list[Comparison]:
    """One row a scenario, then one for all; none where not both robots played."""
    groups = dict(summary["scenarios"])
    if len(groups) > 1:
        levels = summary["levels"]
        groups |= {"all" if len(levels) == 1 else f"all, {name}": levels[name] for name in levels}
    if not any(set(ROBOTS) <= set(group["accuracy"]) for group in groups.values()):
        return []
    return [Comparison(name, tuple(_cells(group))) for name, group in groups.items()]


def _cells(group: Mapping[str, Any]) -> Iterator[Cell]:
    yield Cell("pairs", str(group["pairs"]), ", ".join(_apart(group)))
    for robot in ROBOTS:
        share = group["accuracy"].get(robot)
        notes = [_test(group, ACCURACY)] if robot == INTENTIONAL else []
        undecided = group["undecided"].get(robot)  # of a robot that has played
        notes += [f"{undecided} not decided"] * bool(undecided)
        value = "-" if share is None else f"{100 * share:.1f} %"
        yield Cell(f"{robot} correct", value, ", ".join(filter(None, notes)))
    for measure in MEASURES:
        ratio = group["ratios"][measure]
        yield Cell(in_words(measure), _number(ratio), _test(group, measure))


def _apart(group: Mapping[str, Any]) -> Iterator[str]:
    """How many pairs are counted apart, and why."""
    for reason, key in COUNTS.items():
        if group[key]:
            yield f"{group[key]} {reason}"


def _test(group: Mapping[str, Any], name: str) -> str:
    """Effect and corrected p-value; nothing of a single pair."""
    p, effect = group["holm"][name], group["effects"][name]
    return "" if p is None or group["pairs"] < LEAST else f"{effect:+.2f} ({chance(p)})"


def optima(summary: Mapping[str, Any]) -> list[tuple[str, ...]]:
    """How far each robot is from the least that achieves the goal: scenario or level, OPTIMUM."""
    levels = [name for name in summary["levels"] if name != COARSE]
    groups = summary["levels" if levels else "scenarios"].items()
    return [
        (name, robot, str(own["trials"]), *(_number(own[measure]) for measure in COMPARED))
        for name, group in groups
        for robot, own in sorted(group["optimum"].items())
        if own["trials"]
    ]


def _number(value: float | None) -> str:
    return "-" if value is None else f"{value:.2f}"


def charts(records: Iterable[TrialRecord], apart: Collection[str]) -> list[Chart]:
    """The accuracies and each ratio by scenario or level; none without pairs to compare.

    The pairs that are `apart` do not count.
    """
    groups: dict[str, list[Pair]] = {}
    for first, second in joined((own for own in records if own.pair not in apart), ROBOTS):
        name = place(first.scenario, first.level)
        groups.setdefault(name, []).append((Outline(first), Outline(second)))
    samples = {
        name: Sample(pairs, cluster=lambda pair: pair[0].state)
        for name, pairs in groups.items()
        if len(pairs) >= LEAST
    }
    if not samples:
        return []
    shares = [
        _series(ROBOTS[0], "first", samples, partial(_share, 0)),
        _series(ROBOTS[1], "second", samples, partial(_share, 1), "s"),
    ]
    ratios = [
        Chart(
            f"compared-{name}",
            f"{in_words(name)}, ratio",
            list(samples),
            [_series("ratio", "first", samples, partial(_mean, measure))],
        )
        for name, measure in MEASURES.items()
    ]
    return [Chart("compared-correct", "correct", list(samples), shares, "shares"), *ratios]


def _series(
    label: str,
    colour: Colour,
    samples: Mapping[str, Sample[Pair]],
    estimate: Callable[[Sample[Pair]], Estimate | None],
    marker: str = "o",
) -> Series:
    drawn = points((name, estimate(sample)) for name, sample in samples.items())
    return Series(label, colour, drawn, marker)


def _share(robot: int, sample: Sample[Pair]) -> Estimate | None:
    known = sample.where(lambda pair: pair[robot].decided)
    return known.share(lambda pair: pair[robot].correct)


def _mean(measure: Callable[[Outline], float], sample: Sample[Pair]) -> Estimate | None:
    known = sample.where(lambda pair: all(own.ended for own in pair) and measure(pair[0]))
    return known.mean(lambda pair: measure(pair[1]) / measure(pair[0]))
