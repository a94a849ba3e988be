"""The bootstrap: means, medians, shares and their ratios with intervals, of values in clusters.

Each value has a weight, 1 unless given, and belongs to a cluster: values that are not independent
of each other (repeats from one initial state) have the same label. A resample draws clusters with
replacement, each with all of its values; without labels each value is a cluster of its own.
"""

from collections import defaultdict
from collections.abc import Callable, Hashable, Iterable, Sequence
from dataclasses import dataclass, replace
from functools import partial
from typing import TypeAlias

import numpy as np
import scipy  # type: ignore[import-untyped]  # its parts load when they are used
from numpy.typing import ArrayLike, NDArray

CONFIDENCE = 0.95
RESAMPLES = 1000
BATCH = 50
DRAWN_TOGETHER = 2**15
"""Clusters drawn at the same time, of as many resamples: more do not fit into a cache."""
SEED = 1
TIE = 1e-9
"""Parts of a whole weight that differ by less are the same: what lies between is rounding."""

Values: TypeAlias = NDArray[np.float64]
Counts: TypeAlias = NDArray[np.int64]
Labels: TypeAlias = Iterable[Hashable]


@dataclass(frozen=True)
class Estimate:
    """A value, and the interval in which it lies with 95% confidence.

    One that is `single` is of one independent observation alone, one that is `whole` of a whole
    population: neither has an interval, its ends are the value.
    """

    value: float
    low: float
    high: float
    single: bool = False
    whole: bool = False

    @property
    def ends(self) -> tuple[float, ...]:
        """The ends of its interval, if it has one."""
        return () if self.single or self.whole else (self.low, self.high)

    @property
    def numbers(self) -> dict[str, float | None]:
        """The value and the ends of its interval, which are None where it has none."""
        low, high = self.ends or (None, None)
        return {"value": self.value, "low": low, "high": high}

    @property
    def exactly(self) -> "Estimate":
        """The same without an interval, as of a whole population."""
        return replace(self, low=self.value, high=self.value, whole=True)

    def covers(self, other: float, half_digit: float) -> bool | None:
        """Whether a value, rounded to twice `half_digit`, may lie in the interval.

        Of a whole population: whether it may be the same value. None of a single observation.
        """
        if self.single and not self.whole:
            return None
        return self.low - half_digit <= other <= self.high + half_digit


@dataclass(frozen=True)
class Observations:
    """Values in ascending order, their weights, and the number of the cluster of each."""

    values: Values
    weights: Values
    cluster: Counts
    clusters: int


Statistic: TypeAlias = Callable[[Observations, Counts], Values]
"""Of a sample, and of how often each cluster is in each resample (one row each): its values."""


def sample_of(
    values: ArrayLike, weights: ArrayLike | None = None, clusters: Labels | None = None
) -> Observations:
    """The sample of values with these weights and labels of clusters, one each per value."""
    known = np.asarray(values, dtype=np.float64)
    weighed = np.ones(len(known)) if weights is None else np.asarray(weights, dtype=np.float64)
    cluster = np.arange(len(known)) if clusters is None else numbered(clusters)
    order = np.argsort(known, kind="stable")
    return Observations(known[order], weighed[order], cluster[order], len(np.unique(cluster)))


def numbered(labels: Labels) -> Counts:
    """Numbers from 0 on in place of labels, in the order in which they first come."""
    numbers: dict[Hashable, int] = {}
    return np.array([numbers.setdefault(label, len(numbers)) for label in labels], dtype=np.int64)


def means(sample: Observations, drawn: Counts) -> Values:
    """The weighted mean of each resample."""
    counts = np.bincount(sample.cluster, sample.weights, sample.clusters)
    sums = np.bincount(sample.cluster, sample.weights * sample.values, sample.clusters)
    found: Values = (drawn @ sums) / (drawn @ counts)
    return found


def medians(sample: Observations, drawn: Counts) -> Values:
    """The value of each resample at which half of the weight is reached.

    Where a value ends just there, the mean of it and the next: as in the median of so many copies.
    """
    until = np.cumsum(drawn[:, sample.cluster] * sample.weights, axis=1)
    half = until[:, -1:] / 2
    lower = np.argmax(until > half * (1 - TIE), axis=1)
    upper = np.argmax(until > half * (1 + TIE), axis=1)
    found: Values = (sample.values[lower] + sample.values[upper]) / 2
    return found


def proportion(sample: Observations) -> Estimate | None:
    """The share of ones among zeros and ones; where no resample differs, the exact interval."""
    return as_share(bootstrap(means, sample), sample)


def as_share(mean: Estimate | None, sample: Observations) -> Estimate | None:
    """The mean of zeros and ones, with the exact interval where no resample differs.

    Its number of trials is that of the clusters: what a cluster repeats says nothing new there.
    """
    if mean is None or mean.single or mean.low < mean.high:
        return mean
    return exact(mean.value, sample.clusters)


def exact(share: float, trials: float) -> Estimate:
    """The exact (Clopper-Pearson) interval of a share of trials, whose number need not be whole."""
    tail, right = (1 - CONFIDENCE) / 2, min(share, 1.0) * trials
    wrong = trials - right
    low = float(scipy.stats.beta.ppf(tail, right, wrong + 1)) if right else 0.0
    high = float(scipy.stats.beta.ppf(1 - tail, right + 1, wrong)) if wrong else 1.0
    return Estimate(share, low, high)


def bootstrap(statistic: Statistic, *samples: Observations) -> Estimate | None:
    """The statistic of a sample, or its ratio of the first of two to the second; None of nothing.

    The interval has the percentiles over resamples, each sample being resampled by itself.
    """
    found = _without_interval(statistic, samples)
    if found is None or not _varies(samples):
        return found

    def of_resamples(*drawn: Counts) -> Values:
        each = iter(drawn)
        counts = [next(each) if own.clusters > 1 else _once(own) for own in samples]
        return _of_all(statistic, samples, counts)

    low, high = _interval(of_resamples, [own.clusters for own in samples if own.clusters > 1])
    return replace(found, low=float(low), high=float(high))


def bootstraps(statistic: Statistic, samples: Sequence[Observations]) -> list[Estimate | None]:
    """The statistic of each sample, as of each alone; those of one size are resampled together."""
    found = [_without_interval(statistic, [own]) for own in samples]
    sizes: defaultdict[int, list[int]] = defaultdict(list)
    for number, own in enumerate(samples):
        if _varies([own]):
            sizes[own.clusters].append(number)
    for size, numbers in sizes.items():
        of_each = partial(_stacked, statistic, [samples[number] for number in numbers])
        for number, low, high in zip(numbers, *_interval(of_each, [size]), strict=True):
            found[number] = replace(found[number], low=float(low), high=float(high))  # type: ignore[type-var]
    return found


def _without_interval(statistic: Statistic, samples: Sequence[Observations]) -> Estimate | None:
    """The statistic, with its value as the interval; None of nothing."""
    if not all(own.clusters for own in samples):
        return None
    value = float(_of_all(statistic, samples, list(map(_once, samples)))[0])
    return Estimate(value, value, value, single=all(own.clusters == 1 for own in samples))


def _varies(samples: Iterable[Observations]) -> bool:
    """Whether resamples of one of them may differ from each other."""
    return any(own.clusters > 1 for own in samples) and any(
        own.clusters and own.values[0] != own.values[-1] for own in samples
    )


def _interval(of_resamples: Callable[..., Values], sizes: Sequence[int]) -> tuple[Values, Values]:
    """The ends of the interval of what is a value per resample, of samples with so many clusters.

    It is given per sample how often each cluster is drawn, one row per resample; these are the last
    axis of what it returns.
    """

    def of_indices(*indices: Counts, axis: int = -1) -> Values:
        del axis
        return of_resamples(*map(_times_drawn, indices))

    # Two samples are drawn in turns: with another batch the draws would be others.
    batch = BATCH if len(sizes) > 1 else max(1, DRAWN_TOGETHER // sizes[0])
    interval = scipy.stats.bootstrap(
        list(map(np.arange, sizes)),
        of_indices,
        n_resamples=RESAMPLES,
        batch=batch,
        confidence_level=CONFIDENCE,
        method="percentile",
        rng=np.random.default_rng(SEED),
    ).confidence_interval
    return interval.low, interval.high


def _stacked(statistic: Statistic, samples: Sequence[Observations], drawn: Counts) -> Values:
    return np.stack([statistic(own, drawn) for own in samples])


def _of_all(
    statistic: Statistic, samples: Sequence[Observations], drawn: Sequence[Counts]
) -> Values:
    own = [statistic(sample, counts) for sample, counts in zip(samples, drawn, strict=True)]
    return own[0] if len(own) == 1 else own[0] / own[1]


def _once(sample: Observations) -> Counts:
    return np.ones((1, sample.clusters), dtype=np.int64)


def _times_drawn(indices: Counts) -> Counts:
    """Of indices below their number, one row per resample: how often each of them is there."""
    number = indices.shape[-1]
    rows = indices.reshape(-1, number).astype(np.int64)
    places = rows + number * np.arange(len(rows))[:, None]
    return np.bincount(places.ravel(), minlength=rows.size).reshape(rows.shape)
