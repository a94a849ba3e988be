"""Table 1 for other programs: what an analysis says, as values of JSON."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import TypeAlias

from testbed.analysis.statistics import Estimate, Test
from testbed.studies.table1.published import HALF_CENT, HALF_PERCENT, Published
from testbed.studies.table1.results import Analysis, Ratio, Row, Seconds, Table

Numbers: TypeAlias = dict[str, object]


def numbers(analyses: Iterable[Analysis]) -> dict[str, Numbers]:
    """By the robot that is compared with the traditional one: both tables, and what became what."""
    return {
        own.mind: {
            "triggered": _table(own.triggered, own),
            "random": _table(own.random, own),
            "became": {name: dict(counts) for name, counts in own.became.items()},
        }
        for own in analyses
    }


def _table(table: Table | None, of: Analysis) -> Numbers | None:
    if table is None:
        return None
    rows: Numbers = {row.name: _row(row, table.published.get(row.name), of) for row in table.rows}
    return {"rows": rows, "apart": dict(table.apart)}


def _row(row: Row, paper: Published | None, of: Analysis) -> Numbers:
    theirs = (None, None) if paper is None else (paper.baseline, paper.intentional)
    shares = zip((of.base, of.mind), (row.baseline, row.intentional), theirs, strict=True)
    ratios: Mapping[str, float] = {} if paper is None else paper.ratios
    return {
        "pairs": row.pairs,
        "failed": row.lost,
        "deadline": row.late,
        "unsolvable": row.unsolvable,
        "undecided": row.undecided,
        "out_of_reach": row.out_of_reach,
        "meetings": dict(row.meetings),
        "accuracy": {
            robot: _interval(share, "value") | _beside(share, value, HALF_PERCENT)
            for robot, share, value in shares
        },
        "difference": _interval(row.advantage, "value") | _test(row.accuracy),
        "ratios": {name: _ratio(own, ratios.get(name)) for name, own in row.ratios.items()},
        "optimum": {robot: own.values() for robot, own in row.optimum.items()},
        "times": {name: _seconds(own, of) for name, own in row.times.items()},
    }


def _ratio(ratio: Ratio, published: float | None) -> Numbers:
    return {
        "pairs": ratio.pairs,
        **_interval(ratio.mean, "mean"),
        **_interval(ratio.median, "median", "median_"),
        "of_sums": ratio.of_sums,
        **_test(ratio.test),
        **_beside(ratio.mean, published, HALF_CENT),
    }


def _seconds(own: Seconds, of: Analysis) -> Numbers:
    return {
        "seconds": {of.base: own.baseline, of.mind: own.intentional},
        "pairs": own.ratio.pairs,
        **_interval(own.ratio.mean, "mean"),
        **_interval(own.ratio.median, "median", "median_"),
        "of_sums": own.ratio.of_sums,
    }


def _interval(own: Estimate | None, name: str, prefix: str = "") -> Numbers:
    """A value under its name, and the ends of its interval."""
    ends = (None, None) if own is None or own.single else (own.low, own.high)
    value = None if own is None else own.value
    return {name: value, f"{prefix}low": ends[0], f"{prefix}high": ends[1]}


def _test(test: Test | None) -> Numbers:
    if test is None:
        return {"p": None, "holm": None, "effect": None}
    return {"p": test.p, "holm": test.holm, "effect": test.effect}


def _beside(ours: Estimate | None, published: float | None, half_digit: float) -> Numbers:
    """The published value, and whether it lies in our interval as far as it was rounded."""
    if ours is None or published is None:
        return {"published": published, "inside": None}
    return {"published": published, "inside": ours.covers(published, half_digit)}
