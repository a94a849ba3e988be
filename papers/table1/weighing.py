"""Table 1 of pairs that do not all weigh the same: shares, accuracies and mean ratios."""

from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass

from papers.table1.pairs import Pair
from testbed.analysis.bootstrap import Estimate, bootstrap, exact, means, sample_of
from testbed.analysis.pairs import Ratio
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
    achieved = [own for own in inside if own[0].baseline.correct]
    for name in ("3", "4"):
        yield name + NO_FAILURES, [own for own in achieved if own[0].happened == name]
    yield ALL + NO_FAILURES, achieved


def _row(name: str, own: Sequence[Weighed]) -> Row:
    decided = [(pair, weight) for pair, weight in own if pair.decided]
    ended = [(pair, weight) for pair, weight in own if pair.ended]
    return Row(
        name=name,
        pairs=len(own),
        treatment=_share(decided, lambda pair: pair.treatment.correct),
        baseline=_share(decided, lambda pair: pair.baseline.correct),
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
    return exact(estimate.value, _effective(_by_state(own).values()))


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
    known = [(pair, weight) for pair, weight in own if pair.treatment.measures[measure]]
    ratio = _mean(
        known, lambda pair: pair.baseline.measures[measure] / pair.treatment.measures[measure]
    )
    return Ratio(len(known), ratio, None, None)


def _mean(own: Sequence[Weighed], value: Callable[[Pair], float]) -> Estimate | None:
    values, weights = [value(pair) for pair, _ in own], [weight for _, weight in own]
    return bootstrap(means, sample_of(values, weights, [pair.state for pair, _ in own]))
