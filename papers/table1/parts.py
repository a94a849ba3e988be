"""Table 1 of a part of the random pairs: shares, accuracies and mean ratios, without any test."""

from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass

from papers.table1.pairs import Pair
from testbed.analysis.bootstrap import Estimate, bootstrap, exact, means, sample_of
from testbed.analysis.pairs import Ratio
from testbed.studies.table1.measures import RANDOM, Row, Table
from testbed.studies.table1.published import ALL, MEASURES, NO_FAILURES, SCENARIOS


@dataclass(frozen=True)
class Part:
    """The table of some pairs; `shares` are those of scenarios 1 to 5 in its row of all."""

    table: Table
    shares: dict[str, float]


def part_of(pairs: Iterable[Pair]) -> Part:
    """The table of the random ones among some pairs."""
    inside = [
        pair
        for pair in pairs
        if pair.intended == RANDOM and pair.happened in SCENARIOS and pair.played and pair.decided
    ]
    whole = len(inside) or 1
    return Part(
        table=Table(tuple(_row(name, own) for name, own in _rows(inside)), {}),
        shares={n: sum(pair.happened == n for pair in inside) / whole for n in SCENARIOS},
    )


def _rows(inside: Sequence[Pair]) -> Iterator[tuple[str, Sequence[Pair]]]:
    for name in SCENARIOS:
        yield name, [pair for pair in inside if pair.happened == name]
    yield ALL, inside
    achieved = [pair for pair in inside if pair.baseline.correct]
    for name in ("3", "4"):
        yield name + NO_FAILURES, [pair for pair in achieved if pair.happened == name]
    yield ALL + NO_FAILURES, achieved


def _row(name: str, own: Sequence[Pair]) -> Row:
    ended = [pair for pair in own if pair.ended]
    return Row(
        name=name,
        pairs=len(own),
        treatment=_share(own, lambda pair: pair.treatment.correct),
        baseline=_share(own, lambda pair: pair.baseline.correct),
        accuracy=None,
        ratios={measure: _ratio(ended, measure) for measure in MEASURES},
    )


def _share(own: Sequence[Pair], right: Callable[[Pair], bool]) -> Estimate | None:
    """A proportion; where no resample differs, with the exact interval of as many states."""
    estimate = _mean(own, right)
    if estimate is None or estimate.low < estimate.high:
        return estimate
    return exact(estimate.value, len({pair.state for pair in own}))


def _ratio(own: Sequence[Pair], measure: str) -> Ratio:
    known = [pair for pair in own if pair.treatment.measures[measure]]
    ratio = _mean(
        known, lambda pair: pair.baseline.measures[measure] / pair.treatment.measures[measure]
    )
    return Ratio(len(known), ratio, None, None)


def _mean(own: Sequence[Pair], value: Callable[[Pair], float]) -> Estimate | None:
    values, ones = [value(pair) for pair in own], [1.0] * len(own)
    return bootstrap(means, sample_of(values, ones, [pair.state for pair in own]))
