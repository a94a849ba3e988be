"""Pairs of trials: joined from records, and compared by shares, ratios, and tests of both."""

from __future__ import annotations

import dataclasses
from collections.abc import Callable, Hashable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Generic, TypeVar

import numpy as np

from testbed.analysis import bootstrap
from testbed.analysis.bootstrap import Estimate, Values
from testbed.analysis.statistics import Test, holm, mcnemar, signed_rank
from testbed.experiment.record import TrialRecord

Pair = TypeVar("Pair")
Found = TypeVar("Found")


def joined(
    records: Iterable[TrialRecord], robots: tuple[str, str]
) -> Iterator[tuple[TrialRecord, TrialRecord]]:
    """The records of both robots of a pair, as they are complete; others' are passed over."""
    waiting: dict[str, TrialRecord] = {}
    for record in records:
        if record.robot not in robots:
            continue
        other = waiting.pop(record.pair, None)
        if other is None:
            waiting[record.pair] = record
        else:
            yield (other, record) if other.robot == robots[0] else (record, other)


@dataclass(frozen=True)
class Ratio:
    """A measure of one robot, divided by the other's, over `pairs` in which that is not 0.

    The test compares the measures themselves; its effect is above 0 where the first robot needed
    more. `of_sums` is the ratio of the sums, each pair with its weight.
    """

    pairs: int
    mean: Estimate | None
    median: Estimate | None
    test: Test | None
    of_sums: float | None = None


@dataclass(frozen=True)
class Sample(Generic[Pair]):
    """Pairs, with the stratum that each is from, the weights of strata, and clusters.

    Pairs of one cluster say the same again; without a function for it each says something new.
    """

    pairs: Sequence[Pair]
    stratum: Callable[[Pair], str] = lambda _: ""
    weights: Mapping[str, float] = field(default_factory=lambda: {"": 1.0})
    cluster: Callable[[Pair], Hashable] | None = None

    def where(self, holds: Callable[[Pair], object]) -> Sample[Pair]:
        """The pairs for which this holds."""
        return dataclasses.replace(self, pairs=[pair for pair in self.pairs if holds(pair)])

    def mean(self, value: Callable[[Pair], float]) -> Estimate | None:
        """The mean of a value of pairs."""
        return bootstrap.mean(*self._drawn(value))

    def share(self, holds: Callable[[Pair], float]) -> Estimate | None:
        """The share of the pairs for which this holds."""
        return bootstrap.proportion(*self._drawn(holds))

    def ratio(self, above: Callable[[Pair], float], below: Callable[[Pair], float]) -> Ratio:
        """One measure divided by another."""
        known = self.where(below)
        own = known._drawn(lambda pair: above(pair) / below(pair))
        differences = np.array([above(p) - below(p) for p in self.pairs], dtype=float)
        weighed = [(self._weight(pair), pair) for pair in self.pairs]
        whole = sum(weight * below(pair) for weight, pair in weighed)
        return Ratio(
            pairs=len(known.pairs),
            mean=bootstrap.mean(*own),
            median=bootstrap.median(*own),
            test=signed_rank(differences, self._clusters(), self._weights()),
            of_sums=sum(w * above(pair) for w, pair in weighed) / whole if whole else None,
        )

    def mcnemar(self, first: Callable[[Pair], bool], second: Callable[[Pair], bool]) -> Test | None:
        """The test of what holds of one robot more often than of the other."""
        if not self.pairs:
            return None
        one, other = (
            np.array([holds(p) for p in self.pairs], dtype=bool) for holds in (first, second)
        )
        return mcnemar(one, other, self._clusters(), self._weights())

    def _weight(self, pair: Pair) -> float:
        return self.weights[self.stratum(pair)]

    def _weights(self) -> Values:
        return np.array([self._weight(pair) for pair in self.pairs], dtype=float)

    def _clusters(self) -> list[Hashable] | None:
        return None if self.cluster is None else [self.cluster(pair) for pair in self.pairs]

    def _drawn(
        self, value: Callable[[Pair], float]
    ) -> tuple[list[float], Values, list[Hashable] | None]:
        return [float(value(pair)) for pair in self.pairs], self._weights(), self._clusters()


def corrected(found: Found) -> Found:
    """The same with Holm's correction over all of the tests in it: dataclasses, mappings, lists."""
    tests: list[Test] = []
    _each_test(found, lambda test: tests.append(test) or test)  # type: ignore[func-returns-value]
    values = iter(holm([test.p for test in tests]))
    return _each_test(found, lambda test: dataclasses.replace(test, holm=next(values)))


def _each_test(found: Found, new: Callable[[Test], Test]) -> Found:
    """The same with new tests in place of those in it."""
    if isinstance(found, Test):
        return new(found)  # type: ignore[return-value]
    if isinstance(found, Mapping):
        return {key: _each_test(value, new) for key, value in found.items()}  # type: ignore[return-value]
    if isinstance(found, list):
        return [_each_test(value, new) for value in found]  # type: ignore[return-value]
    if dataclasses.is_dataclass(found) and not isinstance(found, type):
        names = (own.name for own in dataclasses.fields(found))
        parts = {name: _each_test(getattr(found, name), new) for name in names}
        return dataclasses.replace(found, **parts)
    return found
