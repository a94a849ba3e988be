"""Table 1 for other programs: what is added to `summary.json`."""

from collections.abc import Iterable, Mapping
from itertools import zip_longest
from typing import Any

from testbed.analysis.bootstrap import Estimate
from testbed.analysis.pairs import Compared, Ratio
from testbed.analysis.statistics import Test
from testbed.studies.study import Numbers
from testbed.studies.table1.measures import Analysis, Row, Table
from testbed.studies.table1.tables import WAYS, cells
from testbed.studies.tables import Cell


def numbers(analyses: Iterable[Analysis]) -> Numbers:
    """By the robot compared with the traditional one: both tables, and changes of scenario."""
    return {
        "table1": {
            own.robots.treatment: {
                **dict.fromkeys(WAYS),
                **{way: _table(table, own.robots) for way, table in own.tables.items()},
                "became": {name: dict(counts) for name, counts in own.became.items()},
            }
            for own in analyses
        }
    }


def _table(table: Table, robots: Compared) -> Numbers:
    rows = {row.name: _row(row, cells(table, row), robots) for row in table.rows}
    return {"rows": rows, "apart": dict(table.apart)}


def _row(row: Row, beside: Mapping[str, Cell], robots: Compared) -> Numbers:
    return {
        "pairs": row.pairs,
        **row.left_out,
        "undecided": row.undecided,
        "out_of_reach": row.out_of_reach,
        "meetings": dict(row.meetings),
        "accuracy": {
            robot: _interval(beside[key].ours, "value") | _published(beside[key])
            for key, robot in robots._asdict().items()
        },
        "difference": _interval(row.advantage, "value") | _test(row.accuracy),
        "ratios": {
            name: _ratio(own) | _test(own.test) | _published(beside[name])
            for name, own in row.ratios.items()
        },
        "optimum": {robot: dict(own) for robot, own in row.optimum.items()},
        "times": {
            name: {
                "seconds": {robots.baseline: own.baseline, robots.treatment: own.treatment},
                **_ratio(own.ratio),
            }
            for name, own in row.times.items()
        },
    }


def _ratio(own: Ratio) -> dict[str, Any]:
    return {
        "pairs": own.pairs,
        **_interval(own.mean, "mean"),
        **_interval(own.median, "median", "median_"),
        "of_sums": own.of_sums,
    }


def _interval(own: Estimate | None, name: str, prefix: str = "") -> dict[str, Any]:
    """A value under its name, and the ends of its interval."""
    values = () if own is None else (own.value, *own.ends)
    names = (name, f"{prefix}low", f"{prefix}high")
    return dict(zip_longest(names, values))


def _test(test: Test | None) -> dict[str, Any]:
    return {key: None if test is None else getattr(test, key) for key in ("p", "holm", "effect")}


def _published(cell: Cell) -> dict[str, Any]:
    """The published value, and whether it lies in our interval as far as it was rounded."""
    return {
        "published": None if cell.published is None else cell.published.value,
        "inside": cell.inside,
    }
