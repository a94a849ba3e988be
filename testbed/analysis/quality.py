"""How well robots explained over many trials: shares and means, and tests of two robots.

Each event, assumption or explanation counts once, so that a trial counts by how many it has.
"""

from collections.abc import Mapping
from typing import Any

import polars as pl

from testbed.analysis.explanations import PREFIX
from testbed.analysis.pairs import OTHER, Sample
from testbed.analysis.statistics import Test

SHARES: Mapping[str, str] = {
    "explained": "unobserved",
    "action_first": "followed",
    "action_last": "followed",
    "step_first": "followed",
    "step_last": "followed",
    "false": "assumed",
    "false_exceptions": "exceptions",
    "wrongly_distrusted": "distrusted",
}
"""What is counted, and of what it is a share."""
MEANS: Mapping[str, str] = {"latency": "explained", "alternatives": "adopted"}
"""What is a mean in a trial, and of how many."""
OF: Mapping[str, str] = {**SHARES, **MEANS}
SUMS = (*dict.fromkeys(SHARES.values()), "adopted", "more_alternatives")


def values() -> dict[str, pl.Expr]:
    """Each share and mean of a trial; null of nothing."""
    shares = {n: pl.when(_count(of) > 0).then(_count(n) / _count(of)) for n, of in SHARES.items()}
    return shares | {name: _count(name) for name in MEANS}


def numbers(trials: pl.DataFrame) -> dict[str, Any]:
    """The sums, shares and means of measured trials; empty where none is at the coarse resolution.

    The table has the columns of explanations, and `values`.
    """
    known = trials.filter(_count("adopted").is_not_null())
    if not len(known):
        return {}
    sums = {name: _count(name).sum() for name in SUMS}
    found = known.select(trials=pl.len(), **sums, **{name: _mean(name) for name in OF})
    return found.fill_nan(None).row(0, named=True)


def tests(pairs: Sample) -> dict[str, Test | None]:
    """Of the pairs in which both have it: McNemar's test of shares, Wilcoxon's of means."""
    both = {
        name: pairs.where(*(pl.col(name + w).is_not_null() for w in ("", OTHER))) for name in OF
    }
    return {
        name: own.mcnemar(name) if name in SHARES else own.signed_rank(name)
        for name, own in both.items()
    }


def _mean(name: str) -> pl.Expr:
    value, weight = pl.col(name), _count(OF[name])
    return (value * weight).sum() / weight.filter(value.is_not_null()).sum()


def _count(name: str) -> pl.Expr:
    return pl.col(PREFIX + name)
