"""Estimates of what robots do under each condition of a sweep, with intervals."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass

import polars as pl

from testbed.analysis import quality
from testbed.analysis.bootstrap import (
    Estimate,
    Observations,
    as_share,
    bootstraps,
    means,
    sample_of,
)
from testbed.analysis.comparison import by_condition, compared, eventful, with_apart
from testbed.analysis.explanations import PREFIX
from testbed.analysis.pairs import Compared, Sample, cluster_of, pairs_of
from testbed.analysis.population import exhausted_under
from testbed.analysis.run import Run
from testbed.config import ExperimentConfig

VALUES: Mapping[str, pl.Expr] = {
    "achieved": pl.col("achieved").cast(pl.Float64),
    "actions": pl.when("achieved").then("actions"),
    "explanations": pl.col("told"),
    "plans": pl.col("plans"),
    "extra": pl.when("achieved").then(pl.col("execution_units") - pl.col("minimal_units")),
    "regret": pl.when("achieved").then(pl.col("execution_units") - pl.col("oracle_units")),
    "reasoning": 1000 * pl.col("reasoning_time"),
    **{name: pl.when("ended").then(name) for name in quality.OF},
}
"""What a trial counts for in the mean of each measure; null: it does not count."""
SHARES = ("achieved", *quality.SHARES)
COST = "actions"
"""What is divided by what the other robot needed."""


@dataclass(frozen=True)
class Condition:
    """What the trials under one condition come to.

    `pairs` is the number of pairs that count; `robots` has estimates by measure and robot; `cost`
    is what the baseline needed in actions divided by what the treatment did, over the pairs in
    which `both` achieved their goal; None where there is no such pair.
    """

    pairs: int
    both: int
    robots: Mapping[str, Mapping[str, Estimate | None]]
    cost: Estimate | None


def estimates(run: Run, measures: Iterable[str]) -> tuple[Compared, dict[str, Condition]]:
    """The robots that are compared, and by its name what each condition comes to."""
    main, *_ = compared(run.config)
    names, whole = tuple(measures), exhausted_under(run)
    return main, {
        name: _condition(run.conditions[name], rows, whole[name], names, main)
        for name, rows in by_condition(run).items()
    }


def _condition(
    config: ExperimentConfig,
    rows: pl.DataFrame,
    exhausted: frozenset[str],
    measures: Iterable[str],
    main: Compared,
) -> Condition:
    counted = with_apart(rows, main, eventful(config)).filter(pl.col("apart").is_null())
    whole = set(counted["scenario"]) <= exhausted
    pairs = pairs_of(counted, main)
    both = Sample(pairs, cluster_of(pairs), whole=whole).achieved
    return Condition(
        counted["pair"].n_unique(),
        len(both.divisible(COST).pairs),
        _estimates(counted, measures, config.robots, whole),
        both.mean_ratio(COST),
    )


def _estimates(
    trials: pl.DataFrame, measures: Iterable[str], robots: Sequence[str], whole: bool
) -> dict[str, dict[str, Estimate | None]]:
    """The mean of each measure of each robot.

    There is no interval where the trials are a whole population.
    """
    asked = [(measure, name) for measure in measures for name in robots]
    own = {name: trials.filter(robot=name) for name in robots}
    samples = [_sample(own[name], measure) for measure, name in asked]
    found: dict[str, dict[str, Estimate | None]] = {measure: {} for measure, _ in asked}
    for (measure, name), sample, mean in zip(
        asked, samples, bootstraps(means, samples), strict=True
    ):
        estimate = as_share(mean, sample) if measure in SHARES else mean
        found[measure][name] = estimate.exactly if estimate and whole else estimate
    return found


def _sample(trials: pl.DataFrame, measure: str) -> Observations:
    """A measure of trials; what is of events or explanations has the weight of their number."""
    known = trials.with_columns(value=VALUES[measure]).filter(pl.col("value").is_not_null())
    cluster = cluster_of(known)
    labels = None if cluster is None else known[cluster].rank("dense").to_numpy()
    of = quality.OF.get(measure)
    weights = None if of is None else known[PREFIX + of].to_numpy()
    return sample_of(known["value"].to_numpy(), weights, labels)
