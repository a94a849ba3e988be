"""What a run answers: who achieves its goal more often, and who needs less where both do."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from itertools import product
from typing import Any

import polars as pl

from testbed.analysis.bootstrap import CONFIDENCE, Estimate
from testbed.analysis.comparison import by_condition, compared, eventful, with_apart
from testbed.analysis.pairs import OTHER, Compared, Sample, cluster_of, corrected, pairs_of
from testbed.analysis.population import exhausted_under
from testbed.analysis.run import Run
from testbed.analysis.sentences import COST, OVERALL, SUCCESS, sentence
from testbed.analysis.statistics import Test
from testbed.config import ExperimentConfig

MEASURE = "execution_units"
"""What costs are told in."""
ASKED = ("pair", "robot", "scenario", "state", "ended", "achieved", MEASURE)
"""The columns of measured trials that answers are made of."""
MOST_CURVES = 4
"""Curves of a sweep that have answers of their own; of more all conditions are asked together."""


@dataclass(frozen=True)
class Difference:
    """Two robots under one condition: the pairs that are asked about, and a test."""

    condition: str
    pairs: Sample
    test: Test | None

    def told(self, asked: str) -> dict[str, Any] | None:
        """Its numbers, where the robots differ after Holm's correction; else None.

        A mean of ratios may point to another robot than the test of the differences does: then
        nothing is told.
        """
        number, test = len(self.pairs.pairs), self.test
        if number == 1 or test is None or test.holm is None or test.holm >= 1 - CONFIDENCE:
            return None
        values = (_shares if asked == SUCCESS else _ratio)(self.pairs)
        ratio = values.get("ratio")
        if ratio is not None and (ratio.value > 1) != (test.effect > 0):
            return None
        return {
            "condition": self.condition,
            "pairs": number,
            "exhaustive": self.pairs.whole,
            **{name: _numbers(value) for name, value in values.items()},
            **{key: getattr(test, key) for key in ("p", "holm", "effect")},
        }


@dataclass(frozen=True)
class Question:
    """What is asked of two robots under the conditions of one curve, in their order.

    `asked` is `success` or `cost`; `under` is what all of these conditions have in common, "" where
    that is nothing; of a sweep as a whole it is `OVERALL`.
    """

    asked: str
    robots: Compared
    under: str
    differences: Sequence[Difference]


def answers_of(run: Run) -> list[dict[str, Any]]:
    """The answers of a run, as they are in `summary.json`; none where nothing is significant.

    The two questions are who achieves the goal more often, and who needs less where both achieve
    it. Of a sweep each is asked over all conditions, and along the last key that is varied, once
    for each choice of the others. Holm's correction is over the tests of all questions of the run.
    """
    questions = corrected(list(_questions(run)))
    found = ((own, [d.told(own.asked) for d in own.differences]) for own in questions)
    answers = (
        {
            "question": own.asked,
            **own.robots._asdict(),
            "under": own.under,
            "conditions": len(own.differences),
            "differ": [numbers for numbers in told if numbers is not None],
        }
        for own, told in found
        if any(told)
    )
    return [{"sentence": sentence(own), **own} for own in answers]


def _questions(run: Run) -> Iterator[Question]:
    rows, whole = by_condition(run), exhausted_under(run)
    for robots in compared(run.config) if run.config.comparisons else ():
        samples = {
            name: _counted(own, rows[name], robots, whole[name])
            for name, own in run.conditions.items()
        }
        yield from _asked(robots, OVERALL if run.config.is_sweep else "", {"": _pooled(samples)})
        for under, names in _curves(run.config):
            yield from _asked(robots, under, {name: samples[name] for name in names})


def _asked(robots: Compared, under: str, samples: Mapping[str, Sample]) -> Iterator[Question]:
    """Both questions about pairs by condition."""
    shares = [Difference(name, own, own.mcnemar("achieved")) for name, own in samples.items()]
    yield Question(SUCCESS, robots, under, shares)
    both = {name: own.achieved for name, own in samples.items()}
    costs = [Difference(name, own, own.signed_rank(MEASURE)) for name, own in both.items()]
    yield Question(COST, robots, under, costs)


def _pooled(samples: Mapping[str, Sample]) -> Sample:
    pairs = pl.concat(own.pairs for own in samples.values())
    return Sample(pairs, cluster_of(pairs), whole=all(own.whole for own in samples.values()))


def _curves(config: ExperimentConfig) -> Iterator[tuple[str, list[str]]]:
    """Conditions along the last axis of a sweep, and the choice of the others that they share."""
    if not config.is_sweep:
        return
    *others, last = config.sweep.axes
    choices = list(product(*(axis.points for axis in others)))
    if len(choices) > MOST_CURVES:
        yield "", list(config.sweep.cells)
        return
    for choice in choices:
        yield ", ".join(choice), [", ".join([*choice, point]) for point in last.points]


def _counted(
    config: ExperimentConfig, rows: pl.DataFrame, robots: Compared, exhausted: frozenset[str]
) -> Sample:
    """The pairs of two robots that count, of the measured trials of one condition."""
    counted = with_apart(rows, robots, eventful(config)).filter(pl.col("apart").is_null())
    pairs = pairs_of(counted.select(ASKED), robots)
    return Sample(pairs, cluster_of(pairs), whole=set(pairs["scenario"]) <= exhausted)


def _shares(pairs: Sample) -> dict[str, Estimate | None]:
    sides = {"treatment": "achieved" + OTHER, "baseline": "achieved"}
    return {f"{side}_achieved": pairs.share(name) for side, name in sides.items()}


def _ratio(pairs: Sample) -> dict[str, Estimate | None]:
    return {"ratio": pairs.mean_ratio(MEASURE)}


def _numbers(own: Estimate | None) -> dict[str, float | None] | None:
    return None if own is None else own.numbers
