"""Estimates with their uncertainty, paired tests, effect sizes, and Holm's correction of them.

Samples are pooled of strata: of each stratum come its values, and how many times each counts. Where
values belong together (repeats from one initial state), labels of clusters say so: a label for each
value of each stratum. A resample then draws clusters, each with all of its values, of whatever
strata; without labels it draws values, in each stratum by itself.
"""

from __future__ import annotations

from collections.abc import Callable, Hashable, Iterable, Sequence
from dataclasses import dataclass
from typing import TypeAlias

import numpy as np
from numpy.typing import NDArray
from scipy import stats  # type: ignore[import-untyped]  # scipy ships no types

CONFIDENCE = 0.95
RESAMPLES = 1000
BATCH = 50
SEED = 1

Values: TypeAlias = NDArray[np.float64]
Strata: TypeAlias = Sequence[tuple[Values, int]]
Clusters: TypeAlias = Sequence[Iterable[Hashable]]


@dataclass(frozen=True)
class Estimate:
    """A value, and the interval in which it lies with 95% confidence."""

    value: float
    low: float
    high: float

    def covers(self, other: float, half_digit: float) -> bool:
        """Whether a value, rounded to twice `half_digit`, may lie in the interval."""
        return self.low - half_digit <= other <= self.high + half_digit


def mean(strata: Strata, clusters: Clusters | None = None) -> Estimate | None:
    """The mean with its bootstrap interval; None of nothing."""
    return _bootstrap(_sample(strata, clusters), _means)


def median(strata: Strata, clusters: Clusters | None = None) -> Estimate | None:
    """The median with its bootstrap interval; None of nothing."""
    return _bootstrap(_sample(strata, clusters), _medians)


def proportion(strata: Strata, clusters: Clusters | None = None) -> Estimate | None:
    """The share of ones among zeros and ones; where no resample differs, the exact interval.

    Its number of trials is that of the clusters: what a cluster repeats says nothing new there.
    """
    sample = _sample(strata, clusters)
    estimate = _bootstrap(sample, _means)
    if estimate is None or estimate.low < estimate.high:
        return estimate
    exact = stats.binomtest(round(estimate.value * sample.clusters), sample.clusters)
    interval = exact.proportion_ci(CONFIDENCE, method="exact")
    return Estimate(estimate.value, float(interval.low), float(interval.high))


@dataclass(frozen=True)
class _Sample:
    """Values in ascending order, how often each counts, and to which cluster it belongs.

    Clusters are numbered from 0 on; `blocks` says how many of them are resampled among themselves,
    the first so many, then the next.
    """

    values: Values
    times: NDArray[np.int64]
    cluster: NDArray[np.int64]
    blocks: tuple[int, ...]

    @property
    def clusters(self) -> int:
        """How many clusters there are."""
        return sum(self.blocks)


def _sample(strata: Strata, clusters: Clusters | None) -> _Sample:
    sizes = [len(values) for values, _ in strata]
    values = np.concatenate([np.empty(0), *(values for values, _ in strata)])
    times = np.repeat([number for _, number in strata], sizes).astype(np.int64)
    if clusters is None:
        cluster, blocks = np.arange(len(values)), tuple(size for size in sizes if size)
    else:
        labels = [label for own in clusters for label in own]
        numbers = {label: number for number, label in enumerate(dict.fromkeys(labels))}
        cluster, blocks = np.array([numbers[label] for label in labels]), (len(numbers),)
    order = np.argsort(values, kind="stable")
    return _Sample(values[order], times[order], cluster[order], blocks)


Statistic: TypeAlias = Callable[[_Sample, NDArray[np.int64]], Values]
"""Of a sample, and of how often each cluster was drawn in each resample: the value of each."""


def _means(sample: _Sample, drawn: NDArray[np.int64]) -> Values:
    counts = np.bincount(sample.cluster, sample.times, sample.clusters)
    sums = np.bincount(sample.cluster, sample.times * sample.values, sample.clusters)
    means: Values = (drawn @ sums) / (drawn @ counts)
    return means


def _medians(sample: _Sample, drawn: NDArray[np.int64]) -> Values:
    """The middle one of the values, each taken as often as it counts, or the mean of the two."""
    until = np.cumsum(drawn[:, sample.cluster] * sample.times, axis=1)
    total = until[:, -1:]
    lower = np.argmax(until > (total - 1) // 2, axis=1)
    upper = np.argmax(until > total // 2, axis=1)
    medians: Values = (sample.values[lower] + sample.values[upper]) / 2
    return medians


def _bootstrap(sample: _Sample, statistic: Statistic) -> Estimate | None:
    """Percentiles over resamples of the clusters, each of which keeps its values together."""
    if not len(sample.values):
        return None
    once = np.ones((1, sample.clusters), dtype=np.int64)
    value = float(statistic(sample, once)[0])
    varying = [size for size in sample.blocks if size > 1]
    if not varying or sample.values[0] == sample.values[-1]:
        return Estimate(value, value, value)

    def of_resamples(*indices: NDArray[np.int64], axis: int = -1) -> Values:
        del axis
        drawn = iter(_times_drawn(own) for own in indices)
        fixed = np.ones((indices[0].size // indices[0].shape[-1], 1), dtype=np.int64)
        columns = [next(drawn) if size > 1 else fixed for size in sample.blocks]
        return statistic(sample, np.hstack(columns)).reshape(indices[0].shape[:-1])

    interval = stats.bootstrap(
        [np.arange(size) for size in varying],
        of_resamples,
        n_resamples=RESAMPLES,
        batch=BATCH,
        confidence_level=CONFIDENCE,
        method="percentile",
        rng=np.random.default_rng(SEED),
    ).confidence_interval
    return Estimate(value, float(interval.low), float(interval.high))


def _times_drawn(indices: NDArray[np.int64]) -> NDArray[np.int64]:
    """Of indices below their number, a row a resample: how often each of them is there."""
    number = indices.shape[-1]
    rows = indices.reshape(-1, number).astype(np.int64)
    places = rows + number * np.arange(len(rows))[:, None]
    return np.bincount(places.ravel(), minlength=rows.size).reshape(rows.shape)


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


def signed_rank(differences: Values) -> Test | None:
    """Wilcoxon's signed-rank test, with the matched-pairs rank-biserial correlation.

    Pairs without a difference are left out; None where there is no other.
    """
    nonzero = differences[differences != 0]
    if not len(nonzero):
        return None
    ranks = stats.rankdata(np.abs(nonzero))
    effect = float(ranks @ np.sign(nonzero) / ranks.sum())
    return Test(float(stats.wilcoxon(nonzero).pvalue), effect)


def mcnemar(first: NDArray[np.bool_], second: NDArray[np.bool_]) -> Test | None:
    """McNemar's exact test of paired outcomes; the effect is the difference of the proportions.

    None where no pair differs.
    """
    only_first, only_second = int((first & ~second).sum()), int((second & ~first).sum())
    if not only_first + only_second:
        return None
    p = float(stats.binomtest(only_first, only_first + only_second).pvalue)
    return Test(p, (only_first - only_second) / len(first))


def holm(p_values: Sequence[float]) -> list[float]:
    """The p-values after Holm's step-down correction, in the order given."""
    corrected, running = [0.0] * len(p_values), 0.0
    for rank, index in enumerate(sorted(range(len(p_values)), key=p_values.__getitem__)):
        running = max(running, min(1.0, (len(p_values) - rank) * p_values[index]))
        corrected[index] = running
    return corrected
