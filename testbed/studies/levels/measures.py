"""The columns of Tables 2 and 3 (P 4): reasoning of the trials of a level, by robot, compared."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from statistics import fmean, median, stdev

import numpy as np

from testbed.analysis import Run
from testbed.analysis.bootstrap import Estimate, Values, ratio_of_means, ratio_of_medians
from testbed.analysis.statistics import Test
from testbed.studies.levels.load import FineOutline, outlines_of
from testbed.studies.levels.published import FIRST, NO_ZOOM, OWN, PAPER, PARTS, ZOOM, Paper
from testbed.studies.pairs import Ratio, Sample, corrected

Outlines = Sequence[FineOutline]
Pair = tuple[FineOutline, FineOutline]
"""The trial with zooming, and the one without."""


@dataclass(frozen=True)
class Spread:
    """Mean, standard deviation and median of a sample."""

    mean: float
    sd: float
    median: float


@dataclass(frozen=True)
class Reasoning:
    """One robot at a level: how its trials ended, what it did in them; times are seconds.

    Trials that the robot's own error ended count as trials, and as not completed; those that
    something else ended are not among them.
    """

    trials: int
    achieved: int
    out_of_reach: int
    completed: float
    refined_plans: Spread | None
    concrete_actions: Spread | None
    total: Spread | None
    fine: Spread | None
    coarse: Spread | None
    refined_plan: Spread | None


@dataclass(frozen=True)
class Growth:
    """How many times the mean and the median at the first level a time has at this one."""

    mean: Estimate | None
    median: Estimate | None


@dataclass(frozen=True)
class Compared:
    """What can be compared across machines: shares, by robot; ratios, by part; growth, by both.

    A ratio is a time without zooming, divided by that with it, over the pairs of which both trials
    achieved their goal. The tests of shares are McNemar's, of `pairs` that both robots played;
    their effect is above 0 where the one that zooms achieved its goal, or was correct, more often.
    """

    pairs: int
    completed: Mapping[str, Estimate]
    correct: Mapping[str, Estimate]
    ratios: Mapping[str, Ratio]
    growth: Mapping[str, Mapping[str, Growth]]
    completed_test: Test | None
    correct_test: Test | None


@dataclass(frozen=True)
class Level:
    """The columns of a level: `reasoning` by robot, `zoom_ratios` (the means), what is compared."""

    reasoning: Mapping[str, Reasoning]
    zoom_ratios: Mapping[str, float | None]
    compared: Compared


@dataclass(frozen=True)
class Levels:
    """The columns by level, and what they are to be compared with."""

    levels: Mapping[str, Level]
    paper: Paper = OWN


def measures(run: Run, as_published: bool) -> Levels | None:
    """The columns of the levels of a run."""
    levels = analyse(outlines_of(run.records()))
    return Levels(levels, PAPER if as_published else OWN) if levels else None


def analyse(levels: Mapping[str, Outlines]) -> dict[str, Level]:
    """The columns of each level; p-values are corrected over the tests of all of them."""
    first = _by_robot(levels.get(FIRST, ()))
    return corrected({name: _level(name, _by_robot(own), first) for name, own in levels.items()})


def _by_robot(outlines: Outlines) -> dict[str, list[FineOutline]]:
    """The two conditions first, other robots as they come."""
    robots: dict[str, list[FineOutline]] = {ZOOM: [], NO_ZOOM: []}
    for outline in outlines:
        robots.setdefault(outline.robot, []).append(outline)
    return {robot: own for robot, own in robots.items() if own}


def _level(name: str, robots: Mapping[str, Outlines], first: Mapping[str, Outlines]) -> Level:
    pairs = Sample(list(_pairs(robots)))
    decided = pairs.where(lambda pair: all(own.decided for own in pair))
    ended = pairs.where(lambda pair: all(own.achieved for own in pair))
    ratios = {part: _ratio(ended, part) for part in PARTS}
    compared = Compared(
        pairs=len(pairs.pairs),
        completed=_shares(robots, lambda outline: outline.achieved),
        correct=_shares(
            {robot: [o for o in own if o.decided] for robot, own in robots.items()},
            lambda outline: outline.correct,
        ),
        ratios=ratios,
        growth={} if name == FIRST else _growth(robots, first),
        completed_test=pairs.mcnemar(lambda pair: pair[0].achieved, lambda pair: pair[1].achieved),
        correct_test=decided.mcnemar(lambda pair: pair[0].correct, lambda pair: pair[1].correct),
    )
    means = {part: None if r.mean is None else r.mean.value for part, r in ratios.items()}
    return Level({robot: _reasoning(own) for robot, own in robots.items()}, means, compared)


def _pairs(robots: Mapping[str, Outlines]) -> Iterator[Pair]:
    whole = {outline.pair: outline for outline in robots.get(NO_ZOOM, ())}
    for outline in robots.get(ZOOM, ()):
        if outline.pair in whole:
            yield outline, whole[outline.pair]


def _ratio(ended: Sample[Pair], part: str) -> Ratio:
    """Of the pairs that have this part of the time."""
    known = ended.where(lambda pair: pair[0].seconds.get(part) and part in pair[1].seconds)
    return known.ratio(lambda pair: pair[1].seconds[part], lambda pair: pair[0].seconds[part])


def _reasoning(outlines: Outlines) -> Reasoning:
    played = [outline for outline in outlines if outline.played]
    return Reasoning(
        trials=len(outlines),
        achieved=sum(outline.achieved for outline in outlines),
        out_of_reach=sum(outline.out_of_reach for outline in outlines),
        completed=fmean(outline.achieved for outline in outlines),
        refined_plans=_spread(outline.plans for outline in played),
        concrete_actions=_spread(outline.actions for outline in played),
        **{part: _spread(_seconds(played, part)) for part in PARTS},
    )


def _seconds(outlines: Iterable[FineOutline], part: str) -> Values:
    """The seconds of a part of the time, of the trials that have it."""
    return np.array([o.seconds[part] for o in outlines if part in o.seconds], dtype=float)


def _spread(values: Iterable[float]) -> Spread | None:
    """None of nothing."""
    sample = [float(value) for value in values]
    if not sample:
        return None
    return Spread(fmean(sample), stdev(sample) if len(sample) > 1 else 0.0, median(sample))


def _shares(
    robots: Mapping[str, Outlines], holds: Callable[[FineOutline], bool]
) -> dict[str, Estimate]:
    shares = {robot: Sample(own).share(holds) for robot, own in robots.items()}
    return {robot: share for robot, share in shares.items() if share is not None}


def _growth(
    robots: Mapping[str, Outlines], first: Mapping[str, Outlines]
) -> dict[str, dict[str, Growth]]:
    """By robot and part of the time; nothing for a robot that did not play the first level."""
    return {
        robot: {part: _times(_played(own, part), _played(first[robot], part)) for part in PARTS}
        for robot, own in robots.items()
        if robot in first
    }


def _played(outlines: Outlines, part: str) -> Values:
    return _seconds((outline for outline in outlines if outline.played), part)


def _times(above: Values, below: Values) -> Growth:
    return Growth(ratio_of_means(above, below), ratio_of_medians(above, below))
