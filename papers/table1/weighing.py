"""Table 1 of pairs that do not all weigh the same: shares, accuracies and mean ratios."""

from __future__ import annotations

from collections.abc import Callable, Hashable, Iterable, Iterator, Sequence
from dataclasses import dataclass

import numpy as np
from scipy import stats  # type: ignore[import-untyped]  # scipy ships no types

from testbed.analysis.resampling import BATCH, CONFIDENCE, RESAMPLES, SEED, Values
from testbed.analysis.statistics import Estimate
from testbed.studies import Ratio
from testbed.studies.table1.load import Pair
from testbed.studies.table1.measures import Row, Table
from testbed.studies.table1.published import ALL, MEASURES, NO_FAILURES, SCENARIOS

Weighed = tuple[Pair, float]


@dataclass(frozen=True)
class Weighing:
    """A table of weighed pairs; `shares` are the parts of scenarios 1 to 5 in its row of all.

    `inside` is the part of all pairs, by weight, that these scenarios have together. `worth` is how
    many pairs of one weight say as much as these (Kish's effective sample size).
    """

    table: Table
    shares: dict[str, float]
    inside: float
    worth: float


def weighing(pairs: Sequence[Pair], weights: Sequence[float]) -> Weighing:
    """The table of random pairs, each counted with its weight, if it has any."""
    counted = [(p, w) for p, w in zip(pairs, weights, strict=True) if _counts(p) and w > 0]
    inside = [(p, w) for p, w in counted if p.happened in SCENARIOS]
    whole, everything = (sum(w for _, w in own) or 1.0 for own in (inside, counted))
    return Weighing(
        table=Table(tuple(_row(name, own) for name, own in _rows(inside)), {}),
        shares={n: sum(w for p, w in inside if p.happened == n) / whole for n in SCENARIOS},
        inside=sum(w for _, w in inside) / everything,
        worth=_effective(w for _, w in counted),
    )


def _counts(pair: Pair) -> bool:
    return pair.played and pair.decided


def _rows(inside: Sequence[Weighed]) -> Iterator[tuple[str, list[Weighed]]]:
    for name in SCENARIOS:
        yield name, [own for own in inside if own[0].happened == name]
    yield ALL, list(inside)
    achieved = [own for own in inside if own[0].base.correct]
    for name in ("3", "4"):
        yield name + NO_FAILURES, [own for own in achieved if own[0].happened == name]
    yield ALL + NO_FAILURES, achieved


def _row(name: str, own: Sequence[Weighed]) -> Row:
    decided = [(pair, weight) for pair, weight in own if pair.decided]
    ended = [(pair, weight) for pair, weight in own if pair.ended]
    return Row(
        name=name,
        pairs=len(own),
        lost=0,
        unsolvable=0,
        out_of_reach=0,
        meetings={},
        intentional=_share(decided, lambda pair: pair.mind.correct),
        baseline=_share(decided, lambda pair: pair.base.correct),
        accuracy=None,
        ratios={measure: _ratio(ended, measure) for measure in MEASURES},
    )


def _share(own: Sequence[Weighed], right: Callable[[Pair], bool]) -> Estimate | None:
    """A weighted proportion; where no resample differs, with the exact interval.

    Its number of trials is that of the initial states of one weight that say as much (Kish).
    """
    estimate = _mean(own, right)
    if estimate is None or estimate.low < estimate.high:
        return estimate
    return _exact(estimate.value, _effective(_by_state(own).values()))


def _exact(share: float, trials: float) -> Estimate:
    """The exact (Clopper-Pearson) interval of a share of trials, whose number need not be whole."""
    tail, right = (1 - CONFIDENCE) / 2, min(share, 1.0) * trials
    wrong = trials - right
    low = float(stats.beta.ppf(tail, right, wrong + 1)) if right else 0.0
    high = float(stats.beta.ppf(1 - tail, right + 1, wrong)) if wrong else 1.0
    return Estimate(share, low, high)


def _by_state(own: Iterable[Weighed]) -> dict[str, float]:
    weights: dict[str, float] = {}
    for pair, weight in own:
        weights[pair.state] = weights.get(pair.state, 0.0) + weight
    return weights


def _effective(weights: Iterable[float]) -> float:
    """How many of equal weight say as much as these (Kish's effective sample size); 0 of none."""
    known = list(weights)
    return sum(known) ** 2 / (sum(w * w for w in known) or 1.0)


def _ratio(own: Sequence[Weighed], measure: str) -> Ratio:
    known = [(pair, weight) for pair, weight in own if pair.mind.measures[measure]]
    mean = _mean(known, lambda pair: pair.base.measures[measure] / pair.mind.measures[measure])
    return Ratio(len(known), mean, None, None)


def _mean(own: Sequence[Weighed], value: Callable[[Pair], float]) -> Estimate | None:
    values = np.array([value(pair) for pair, _ in own], dtype=float)
    weights = np.array([weight for _, weight in own], dtype=float)
    return weighted_mean(values, weights, [pair.state for pair, _ in own])


def weighted_mean(values: Values, weights: Values, clusters: Sequence[Hashable]) -> Estimate | None:
    """The weighted mean, with its bootstrap interval over clusters; None of nothing.

    Each value has the label of its cluster. A resample draws clusters, each with all it has.
    """
    if not len(values):
        return None
    labels = {label: number for number, label in enumerate(dict.fromkeys(clusters))}
    places = np.array([labels[label] for label in clusters], dtype=np.int64)
    sums, sizes = np.bincount(places, weights * values), np.bincount(places, weights)
    mean = float(sums.sum() / sizes.sum())
    if len(labels) == 1 or np.ptp(values) == 0:
        return Estimate(mean, mean, mean)
    interval = stats.bootstrap(
        (sums, sizes),
        lambda above, below, axis: above.sum(axis=axis) / below.sum(axis=axis),
        paired=True,
        vectorized=True,
        n_resamples=RESAMPLES,
        batch=BATCH,
        confidence_level=CONFIDENCE,
        method="percentile",
        rng=np.random.default_rng(SEED),
    ).confidence_interval
    return Estimate(mean, float(interval.low), float(interval.high))
