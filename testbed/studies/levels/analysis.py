"""The columns of Tables 2 and 3 (P 4): reasoning of the trials of a level, by robot, compared."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from statistics import fmean, median, stdev

import msgspec
import numpy as np

from testbed.analysis import quotient, statistics
from testbed.analysis.statistics import Estimate, Test, Values, holm, mcnemar, signed_rank
from testbed.studies.levels.numbers import numbers
from testbed.studies.levels.outline import FineOutline
from testbed.studies.levels.published import FIRST, NO_ZOOM, PARTS, ZOOM, Paper
from testbed.studies.levels.results import Compared, Growth, Level, Ratio, Reasoning, Spread

Outlines = Sequence[FineOutline]
Pair = tuple[FineOutline, FineOutline]
"""The trial with zooming, and the one without."""


def summarise_levels(levels: Mapping[str, Outlines], paper: Paper) -> dict[str, dict[str, object]]:
    """The columns of each level as a summary holds them, `published` where something was."""
    found = analyse(levels)
    beside = numbers(found, paper)
    return {
        name: msgspec.to_builtins(level) | ({"published": beside[name]} if beside[name] else {})
        for name, level in found.items()
    }


def analyse(levels: Mapping[str, Outlines]) -> dict[str, Level]:
    """The columns of each level; p-values are corrected over the tests of all of them."""
    first = _by_robot(levels.get(FIRST, ()))
    return _corrected({name: _level(name, _by_robot(own), first) for name, own in levels.items()})


def _by_robot(outlines: Outlines) -> dict[str, list[FineOutline]]:
    """The two conditions first, other robots as they come."""
    robots: dict[str, list[FineOutline]] = {ZOOM: [], NO_ZOOM: []}
    for outline in outlines:
        robots.setdefault(outline.robot, []).append(outline)
    return {robot: own for robot, own in robots.items() if own}


def _level(name: str, robots: Mapping[str, Outlines], first: Mapping[str, Outlines]) -> Level:
    pairs = list(_pairs(robots))
    ratios = {part: _ratio(pairs, part) for part in PARTS}
    zoomed, whole = (np.array([p[i].achieved for p in pairs], dtype=bool) for i in (0, 1))
    decided = [pair for pair in pairs if all(own.decided for own in pair)]
    right, others = (np.array([p[i].correct for p in decided], dtype=bool) for i in (0, 1))
    compared = Compared(
        pairs=len(pairs),
        completed=_shares(robots, lambda outline: outline.achieved),
        correct=_shares(
            {robot: [o for o in own if o.decided] for robot, own in robots.items()},
            lambda outline: outline.correct,
        ),
        ratios=ratios,
        growth={} if name == FIRST else _growth(robots, first),
        completed_test=mcnemar(zoomed, whole) if pairs else None,
        correct_test=mcnemar(right, others) if decided else None,
    )
    means = {part: None if r.mean is None else r.mean.value for part, r in ratios.items()}
    return Level({robot: _reasoning(own) for robot, own in robots.items()}, means, compared)


def _pairs(robots: Mapping[str, Outlines]) -> Iterator[Pair]:
    whole = {outline.pair: outline for outline in robots.get(NO_ZOOM, ())}
    for outline in robots.get(ZOOM, ()):
        if outline.pair in whole:
            yield outline, whole[outline.pair]


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
    robots: Mapping[str, Outlines], value: Callable[[FineOutline], bool | None]
) -> dict[str, Estimate]:
    known = {r: [v for v in map(value, own) if v is not None] for r, own in robots.items()}
    found = {
        robot: statistics.proportion([(np.array(own, dtype=float), 1)])
        for robot, own in known.items()
    }
    return {robot: share for robot, share in found.items() if share is not None}


def _ratio(pairs: Iterable[Pair], part: str) -> Ratio:
    """Over the pairs of which both trials achieved their goal."""
    times = [
        (zoomed.seconds[part], whole.seconds[part])
        for zoomed, whole in pairs
        if zoomed.achieved and whole.achieved and zoomed.seconds.get(part) and part in whole.seconds
    ]
    below, above = (np.array([own[i] for own in times], dtype=float) for i in (0, 1))
    ratios = [(above / below, 1)]
    mean, middle = statistics.mean(ratios), statistics.median(ratios)
    of_sums = float(above.sum() / below.sum()) if times else None
    return Ratio(len(times), mean, middle, signed_rank(above - below), of_sums)


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
    return Growth(quotient.of_means(above, below), quotient.of_medians(above, below))


def _corrected(levels: Mapping[str, Level]) -> dict[str, Level]:
    """The levels with Holm's correction over all of their tests."""
    tests = [test for level in levels.values() for test in _tests(level.compared)]
    corrected = iter(holm([test.p for test in tests]))

    def with_holm(test: Test | None) -> Test | None:
        return None if test is None else Test(test.p, test.effect, next(corrected))

    replace = msgspec.structs.replace

    def compared(own: Compared) -> Compared:
        ratios = {p: replace(ratio, test=with_holm(ratio.test)) for p, ratio in own.ratios.items()}
        completed, correct = with_holm(own.completed_test), with_holm(own.correct_test)
        return replace(own, ratios=ratios, completed_test=completed, correct_test=correct)

    return {
        name: replace(level, compared=compared(level.compared)) for name, level in levels.items()
    }


def _tests(compared: Compared) -> list[Test]:
    """In the order in which they are corrected."""
    of_ratios = [ratio.test for ratio in compared.ratios.values()]
    tests = [*of_ratios, compared.completed_test, compared.correct_test]
    return [test for test in tests if test is not None]
