"""Estimates with their uncertainty, paired tests, effect sizes, and Holm\'s correction of them.

Samples are pooled of strata: of each stratum come its values, and how many times each counts.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any, TypeAlias

import numpy as np
from numpy.typing import NDArray
from scipy import stats  # type: ignore[import-untyped]  # scipy ships no types

CONFIDENCE = 0.95
RESAMPLES = 1000
SEED = 1

Values: TypeAlias = NDArray[np.float64]
Strata: TypeAlias = Sequence[tuple[Values, int]]


@dataclass(frozen=True)
class Estimate:
    """A value, and the interval in which it lies with 95% confidence."""

    value: float
    low: float
    high: float

    def covers(self, other: float, half_digit: float) -> bool:
        """Whether a value, rounded to twice `half_digit`, may lie in the interval."""
        return self.low - half_digit <= other <= self.high + half_digit


def mean(strata: Strata) -> Estimate | None:
    """The mean with its bootstrap interval; None of nothing."""
    return _bootstrap(strata, np.mean)


def median(strata: Strata) -> Estimate | None:
    """The median with its bootstrap interval; None of nothing."""
    return _bootstrap(strata, np.median)


def proportion(strata: Strata) -> Estimate | None:
    """The share of ones among zeros and ones; where all are alike the exact interval.

    The bootstrap says nothing there: no resample differs.
    """
    estimate = mean(strata)
    if estimate is None or estimate.low < estimate.high:
        return estimate
    number = sum(len(values) for values, _ in strata)
    exact = stats.binomtest(round(estimate.value * number), number)
    interval = exact.proportion_ci(CONFIDENCE, method="exact")
    return Estimate(estimate.value, float(interval.low), float(interval.high))


def _bootstrap(strata: Strata, statistic: Any) -> Estimate | None:
    """Percentiles over resamples, each stratum being resampled by itself."""
    own = [(values, times) for values, times in strata if len(values)]
    if not own:
        return None
    times = [number for _, number in own]

    def pooled(*samples: Values, axis: int = -1) -> Any:
        return statistic(_pool(samples, times, axis), axis=axis)

    value = float(pooled(*(values for values, _ in own)))
    if all(np.ptp(values) == 0 for values, _ in own):
        return Estimate(value, value, value)
    interval = stats.bootstrap(
        [values if len(values) > 1 else np.repeat(values, 2) for values, _ in own],
        pooled,
        n_resamples=RESAMPLES,
        batch=50,
        confidence_level=CONFIDENCE,
        method="percentile",
        rng=np.random.default_rng(SEED),
    ).confidence_interval
    return Estimate(value, float(interval.low), float(interval.high))


def _pool(samples: Sequence[Values], times: Sequence[int], axis: int) -> Values:
    repeated = [np.repeat(s, number, axis=axis) for s, number in zip(samples, times, strict=True)]
    return np.concatenate(repeated, axis=axis)


@dataclass(frozen=True)
class Test:
    """A paired test: how likely such a difference is by chance, and how large it is.

    `effect` lies between -1 and 1 and is above 0 where the first of the two has more; `holm` is the
    p-value after Holm\'s correction, None before it.
    """

    __test__ = False

    p: float
    effect: float
    holm: float | None = None


def signed_rank(differences: Values) -> Test | None:
    """Wilcoxon\'s signed-rank test, with the matched-pairs rank-biserial correlation.

    Pairs without a difference are left out; None where there is no other.
    """
    nonzero = differences[differences != 0]
    if not len(nonzero):
        return None
    ranks = stats.rankdata(np.abs(nonzero))
    effect = float(ranks @ np.sign(nonzero) / ranks.sum())
    return Test(float(stats.wilcoxon(nonzero).pvalue), effect)


def mcnemar(first: NDArray[np.bool_], second: NDArray[np.bool_]) -> Test | None:
    """McNemar\'s exact test of paired outcomes; the effect is the difference of the proportions.

    None where no pair differs.
    """
    only_first, only_second = int((first & ~second).sum()), int((second & ~first).sum())
    if not only_first + only_second:
        return None
    p = float(stats.binomtest(only_first, only_first + only_second).pvalue)
    return Test(p, (only_first - only_second) / len(first))


def holm(p_values: Sequence[float]) -> list[float]:
    """The p-values after Holm\'s step-down correction, in the order given."""
    corrected, running = [0.0] * len(p_values), 0.0
    for rank, index in enumerate(sorted(range(len(p_values)), key=p_values.__getitem__)):
        running = max(running, min(1.0, (len(p_values) - rank) * p_values[index]))
        corrected[index] = running
    return corrected
