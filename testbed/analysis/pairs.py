"""Pairs of trials of two robots, and what they come to: shares, ratios, and tests of both."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, fields, is_dataclass, replace
from typing import Any, NamedTuple, TypeVar

import polars as pl

from testbed.analysis.bootstrap import Estimate, bootstrap, means, medians, proportion, sample_of
from testbed.analysis.statistics import Test, holm, mcnemar, signed_rank

Found = TypeVar("Found")
OTHER = " of the treatment"
"""The end of a column's name in `pairs_of` that is of the treatment's trial."""


class Compared(NamedTuple):
    """The two robots of a comparison: ratios are those of the baseline to the treatment."""

    baseline: str
    treatment: str


def pairs_of(trials: pl.DataFrame, robots: Compared) -> pl.DataFrame:
    """One row per pair of trials, in the order in which they became complete.

    The columns are those of the baseline's trial, then with `OTHER` those of the treatment's;
    `number` is the place of a trial in the table.
    """
    numbered = trials.with_row_index("number")
    base, own = (numbered.filter(pl.col("robot") == name) for name in robots)
    return base.join(own, on="pair", suffix=OTHER).sort(
        pl.max_horizontal("number", "number" + OTHER)
    )


def cluster_of(trials: pl.DataFrame) -> str | None:
    """The column of clusters: trials from one initial state, unless all are from a single one."""
    return "state" if trials["state"].n_unique() > 1 else None


@dataclass(frozen=True)
class Ratio:
    """A measure of the baseline, divided by the treatment's, over `pairs` in which that is not 0.

    The test compares the measures themselves; its effect is above 0 where the baseline needed
    more. `of_sums` is the ratio of the sums, each pair with its weight.
    """

    pairs: int
    mean: Estimate | None
    median: Estimate | None
    test: Test | None
    of_sums: float | None = None


@dataclass(frozen=True)
class Sample:
    """Pairs as `pairs_of` has them, with the columns of their clusters and weights, if any.

    Pairs of one cluster say the same again; without such a column each says something new. Where
    the pairs are `whole`, the population itself and no sample of it, estimates have no interval.
    """

    pairs: pl.DataFrame
    cluster: str | None = "state"
    weight: str | None = None
    whole: bool = False

    def where(self, *holds: str | pl.Expr) -> Sample:
        """The pairs for which this holds."""
        return replace(self, pairs=self.pairs.filter(*holds))

    @property
    def ended(self) -> Sample:
        """The pairs of which no trial ended in an error: the measures are of whole trials."""
        return self.where("ended", "ended" + OTHER)

    @property
    def achieved(self) -> Sample:
        """The pairs in which both achieve their goal: who fails early has not needed less."""
        return self.ended.where("achieved", "achieved" + OTHER)

    @property
    def decided(self) -> Sample:
        """The pairs of which it is known of both trials if they were correct."""
        return self.where(*(pl.col("correct" + who).is_not_null() for who in ("", OTHER)))

    def mean(self, value: pl.Expr) -> Estimate | None:
        """The mean of a value of pairs; None of none."""
        return self._estimate(bootstrap, means, sample_of(self._values(value), **self._labels))

    def share(self, holds: str) -> Estimate | None:
        """The share of the pairs, of which it is known, for which this holds; None of none."""
        known = self.where(pl.col(holds).is_not_null())
        return self._estimate(proportion, sample_of(known.pairs[holds], **known._labels))

    def ratio(self, name: str) -> Ratio:
        """A measure of the baseline divided by the treatment's."""
        above, below = pl.col(name), pl.col(name + OTHER)
        known = self.divisible(name)
        quotients = sample_of(known._values(above / below), **known._labels)
        weight = pl.lit(1.0) if self.weight is None else pl.col(self.weight)
        sums = self.pairs.select(a=(weight * above).sum(), b=(weight * below).sum()).row(0)
        return Ratio(
            pairs=len(known.pairs),
            mean=self._estimate(bootstrap, means, quotients),
            median=self._estimate(bootstrap, medians, quotients),
            test=self.signed_rank(name),
            of_sums=sums[0] / sums[1] if sums[1] else None,
        )

    def divisible(self, name: str) -> Sample:
        """The pairs in which the treatment's measure is not 0."""
        return self.where(pl.col(name + OTHER) != 0)

    def mean_ratio(self, name: str) -> Estimate | None:
        """The mean of a measure of the baseline divided by the treatment's; None of none."""
        return self.divisible(name).mean(pl.col(name) / pl.col(name + OTHER))

    def signed_rank(self, name: str) -> Test | None:
        """Wilcoxon's test of a measure; the effect is above 0 where the baseline has more."""
        return signed_rank(self._values(pl.col(name) - pl.col(name + OTHER)), **self._labels)

    def mcnemar(self, name: str) -> Test | None:
        """McNemar's test of what holds of trials; above 0 where it does of more treatments."""
        own, base = (self.pairs[who].to_numpy() for who in (name + OTHER, name))
        return mcnemar(own, base, **self._labels)

    def _estimate(self, estimate: Callable[..., Estimate | None], *of: object) -> Estimate | None:
        found = estimate(*of)
        return found.exactly if found and self.whole else found

    def _values(self, value: pl.Expr) -> Any:
        return self.pairs.select(value.cast(pl.Float64)).to_series().to_numpy()

    @property
    def _labels(self) -> dict[str, Any]:
        columns = {"weights": self.weight, "clusters": self.cluster}
        return {key: self.pairs[name].to_numpy() for key, name in columns.items() if name}


def corrected(found: Found) -> Found:
    """The same with Holm's correction over all of the tests in it: dataclasses, mappings, lists."""
    tests: list[Test] = []
    _each_test(found, lambda test: tests.append(test) or test)  # type: ignore[func-returns-value]
    values = iter(holm([test.p for test in tests]))
    return _each_test(found, lambda test: replace(test, holm=next(values)))


def _each_test(found: Found, new: Callable[[Test], Test]) -> Found:
    """The same with new tests in place of those in it."""
    match found:
        case Test():
            return new(found)  # type: ignore[return-value]
        case Mapping():
            return {key: _each_test(value, new) for key, value in found.items()}  # type: ignore[return-value]
        case list():
            return [_each_test(value, new) for value in found]  # type: ignore[return-value]
        case _ if is_dataclass(found) and not isinstance(found, type):
            names = (own.name for own in fields(found))
            parts = {name: _each_test(getattr(found, name), new) for name in names}
            return replace(found, **parts)
    return found
