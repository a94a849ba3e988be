"""Estimates with their uncertainty, paired tests, effect sizes, and Holm's correction of them."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy import stats  # type: ignore[import-untyped]  # scipy ships no types

from testbed.analysis.resampling import (
    CONFIDENCE,
    Clusters,
    Labels,
    Sample,
    Statistic,
    Strata,
    Values,
    bootstrap,
    cluster_means,
    means,
    medians,
    sample_of,
)

__all__ = [
    "Clusters",
    "Estimate",
    "Strata",
    "Test",
    "Values",
    "holm",
    "mcnemar",
    "mean",
    "median",
    "proportion",
    "signed_rank",
]


@dataclass(frozen=True)
class Estimate:
    """A value, and the interval in which it lies with 95% confidence.

    One that is `single` is of one independent observation alone, and has no interval: its ends are
    the value.
    """

    value: float
    low: float
    high: float
    single: bool = False

    def covers(self, other: float, half_digit: float) -> bool | None:
        """Whether a value, rounded to twice `half_digit`, may lie in the interval, if any."""
        if self.single:
            return None
        return self.low - half_digit <= other <= self.high + half_digit


def mean(strata: Strata, clusters: Clusters | None = None) -> Estimate | None:
    """The mean with its bootstrap interval; None of nothing."""
    return _estimate(sample_of(strata, clusters), means)


def median(strata: Strata, clusters: Clusters | None = None) -> Estimate | None:
    """The median with its bootstrap interval; None of nothing."""
    return _estimate(sample_of(strata, clusters), medians)


def proportion(strata: Strata, clusters: Clusters | None = None) -> Estimate | None:
    """The share of ones among zeros and ones; where no resample differs, the exact interval.

    Its number of trials is that of the clusters: what a cluster repeats says nothing new there.
    """
    sample = sample_of(strata, clusters)
    estimate = _estimate(sample, means)
    if estimate is None or estimate.single or estimate.low < estimate.high:
        return estimate
    exact = stats.binomtest(round(estimate.value * sample.clusters), sample.clusters)
    interval = exact.proportion_ci(CONFIDENCE, method="exact")
    return Estimate(estimate.value, float(interval.low), float(interval.high))


def _estimate(sample: Sample, statistic: Statistic) -> Estimate | None:
    if not len(sample.values):
        return None
    return Estimate(*bootstrap(sample, statistic), single=sample.clusters == 1)


@dataclass(frozen=True)
class Test:
    """A paired test: how likely such a difference is by chance, and how large it is.

    `effect` lies between -1 and 1 and is above 0 where the first of the two has more; `holm` is the
    p-value after Holm's correction, None before it.
    """

    __test__ = False

    p: float
    effect: float
    holm: float | None = None


def signed_rank(
    differences: Values, clusters: Labels | None = None, weights: Values | None = None
) -> Test | None:
    """Wilcoxon's signed-rank test, with the matched-pairs rank-biserial correlation.

    Pairs without a difference are left out; None where there is no other. With labels both are of
    the clusters' mean differences, which are independent; in these means the weights count.
    """
    if not differences.any():
        return None
    tested = cluster_means(differences, clusters, weights)
    nonzero = tested[tested != 0]
    if not len(nonzero):
        return Test(1.0, 0.0)
    ranks = stats.rankdata(np.abs(nonzero))
    effect = float(ranks @ np.sign(nonzero) / ranks.sum())
    return Test(float(stats.wilcoxon(nonzero).pvalue), effect)


def mcnemar(
    first: NDArray[np.bool_],
    second: NDArray[np.bool_],
    clusters: Labels | None = None,
    weights: Values | None = None,
) -> Test | None:
    """McNemar's exact test of paired outcomes; the effect is the difference of the proportions.

    None where no pair differs. With labels the test counts the clusters in which one of the two is
    right more often than the other, by weight where there are weights.
    """
    differences = first.astype(float) - second.astype(float)
    if not differences.any():
        return None
    tested = cluster_means(differences, clusters, weights)
    only_first, only_second = int((tested > 0).sum()), int((tested < 0).sum())
    number = only_first + only_second
    p = float(stats.binomtest(only_first, number).pvalue) if number else 1.0
    return Test(p, float(np.average(differences, weights=weights)))


def holm(p_values: Sequence[float]) -> list[float]:
    """The p-values after Holm's step-down correction, in the order given."""
    corrected, running = [0.0] * len(p_values), 0.0
    for rank, index in enumerate(sorted(range(len(p_values)), key=p_values.__getitem__)):
        running = max(running, min(1.0, (len(p_values) - rank) * p_values[index]))
        corrected[index] = running
    return corrected
