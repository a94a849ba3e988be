"""Samples of values that come in strata and clusters, and the bootstrap of what they come to.

Samples are pooled of strata: of each stratum come its values, and the weight of each. Where
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
TIE = 1e-9
"""Parts of a whole weight that differ by less are the same: what lies between is rounding."""
DIGITS = 12
"""Decimals of a mean of differences: what comes behind them is rounding."""

Values: TypeAlias = NDArray[np.float64]
Counts: TypeAlias = NDArray[np.int64]
Labels: TypeAlias = Iterable[Hashable]
Strata: TypeAlias = Sequence[tuple[Values, float]]
Clusters: TypeAlias = Sequence[Labels]


@dataclass(frozen=True)
class Sample:
    """Values in ascending order, what each weighs, and to which cluster it belongs.

    Clusters are numbered from 0 on; `blocks` says how many of them are resampled among themselves,
    the first so many, then the next.
    """

    values: Values
    weights: Values
    cluster: Counts
    blocks: tuple[int, ...]

    @property
    def clusters(self) -> int:
        """How many clusters there are."""
        return sum(self.blocks)


def sample_of(strata: Strata, clusters: Clusters | None) -> Sample:
    """The values of all strata, by cluster."""
    sizes = [len(values) for values, _ in strata]
    values = np.concatenate([np.empty(0), *(values for values, _ in strata)])
    weights = np.repeat([weight for _, weight in strata], sizes).astype(np.float64)
    if clusters is None:
        cluster, blocks = np.arange(len(values)), tuple(size for size in sizes if size)
    else:
        cluster = _numbered(label for own in clusters for label in own)
        blocks = (len(set(cluster.tolist())),)
    order = np.argsort(values, kind="stable")
    return Sample(values[order], weights[order], cluster[order], blocks)


def cluster_means(values: Values, clusters: Labels | None, weights: Values | None = None) -> Values:
    """The mean of each cluster, weighted if there are weights; without labels the values."""
    if clusters is None:
        return values
    cluster = _numbered(clusters)
    own = np.ones(len(values)) if weights is None else weights
    means: Values = np.bincount(cluster, own * values) / np.bincount(cluster, own)
    return np.round(means, DIGITS)


def _numbered(labels: Labels) -> Counts:
    """Numbers in place of labels, in the order in which they first come."""
    known = list(labels)
    numbers = {label: number for number, label in enumerate(dict.fromkeys(known))}
    return np.array([numbers[label] for label in known], dtype=np.int64)


Statistic: TypeAlias = Callable[[Sample, Counts], Values]
"""Of a sample, and of how often each cluster was drawn in each resample: the value of each."""


def means(sample: Sample, drawn: Counts) -> Values:
    """The mean of each resample."""
    counts = np.bincount(sample.cluster, sample.weights, sample.clusters)
    sums = np.bincount(sample.cluster, sample.weights * sample.values, sample.clusters)
    found: Values = (drawn @ sums) / (drawn @ counts)
    return found


def medians(sample: Sample, drawn: Counts) -> Values:
    """The value of each resample at which half of the weight is reached.

    Where a value ends just there, the mean of it and the next: as in the median of so many copies.
    """
    until = np.cumsum(drawn[:, sample.cluster] * sample.weights, axis=1)
    half = until[:, -1:] / 2
    lower = np.argmax(until > half * (1 - TIE), axis=1)
    upper = np.argmax(until > half * (1 + TIE), axis=1)
    found: Values = (sample.values[lower] + sample.values[upper]) / 2
    return found


def bootstrap(sample: Sample, statistic: Statistic) -> tuple[float, float, float]:
    """The value of a sample that is not empty, and percentiles over resamples of its clusters."""
    once = np.ones((1, sample.clusters), dtype=np.int64)
    value = float(statistic(sample, once)[0])
    varying = [size for size in sample.blocks if size > 1]
    if not varying or sample.values[0] == sample.values[-1]:
        return value, value, value

    def of_resamples(*indices: Counts, axis: int = -1) -> Values:
        del axis
        shape = indices[0].shape[:-1]
        drawn = iter(_times_drawn(own) for own in indices)
        fixed = np.ones((int(np.prod(shape)), 1), dtype=np.int64)
        columns = [next(drawn) if size > 1 else fixed for size in sample.blocks]
        return statistic(sample, np.hstack(columns)).reshape(shape)

    interval = stats.bootstrap(
        [np.arange(size) for size in varying],
        of_resamples,
        n_resamples=RESAMPLES,
        batch=BATCH,
        confidence_level=CONFIDENCE,
        method="percentile",
        rng=np.random.default_rng(SEED),
    ).confidence_interval
    return value, float(interval.low), float(interval.high)


def _times_drawn(indices: Counts) -> Counts:
    """Of indices below their number, a row a resample: how often each of them is there."""
    number = indices.shape[-1]
    rows = indices.reshape(-1, number).astype(np.int64)
    places = rows + number * np.arange(len(rows))[:, None]
    return np.bincount(places.ravel(), minlength=rows.size).reshape(rows.shape)
