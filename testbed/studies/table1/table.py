"""Table 1 as cells of text: ours with its interval, the published value, and whether they agree."""

from __future__ import annotations

from collections.abc import Iterator

from testbed.analysis.statistics import Estimate, Test
from testbed.experiment.wording import chance
from testbed.studies.levels.table import MARKED, OUTSIDE
from testbed.studies.table1.analysis import Row, Table
from testbed.studies.table1.published import HALF_CENT, HALF_PERCENT, MEASURES, Published
from testbed.text.grid import Grid

HEADINGS = ("total time", "plans", "planning time", "exec. time", "actions")
"""The published names of the measures."""

COLUMNS = ("scenario", "pairs", *HEADINGS, "TP acc.", "ATI acc.")
Cells = tuple[str, ...]


def rows_of(table: Table) -> Iterator[Cells]:
    """For each row: our means with intervals; the published values, those outside marked `*`."""
    for row in table.rows:
        if not row.pairs:
            continue
        yield (
            row.name,
            str(row.pairs),
            *(_ratio(row.ratios[m].mean) for m in MEASURES),
            *_shares(row),
        )
        yield ("  median", "", *(_ratio(row.ratios[m].median) for m in MEASURES), "", "")
        if row.name in table.published:
            yield ("  published", "", *_published(row, table.published[row.name]))


def tests_of(table: Table) -> Iterator[Cells]:
    """For each row the effect sizes, with the p-values after Holm's correction."""
    for row in table.rows:
        if row.pairs:
            yield (row.name, *(_effect(row.ratios[m].test) for m in MEASURES), _advantage(row))


def _effect(test: Test | None) -> str:
    return "-" if test is None else f"{test.effect:+.2f} ({chance(test.holm)})"


def _advantage(row: Row) -> str:
    difference = row.advantage
    if row.accuracy is None or difference is None:
        return "-"
    interval = "" if difference.single else f" [{difference.low:+.2f}, {difference.high:+.2f}]"
    return f"{difference.value:+.2f}{interval} ({chance(row.accuracy.holm)})"


def number(value: float | None) -> str:
    """A ratio with two decimals."""
    return "-" if value is None else f"{value:.2f}"


def _ratio(estimate: Estimate | None) -> str:
    if estimate is None:
        return "-"
    interval = "" if estimate.single else f" [{estimate.low:.2f}, {estimate.high:.2f}]"
    return f"{estimate.value:.2f}{interval}"


def _shares(row: Row) -> Iterator[str]:
    for share in (row.baseline, row.intentional):
        yield "-" if share is None else interval(share)


def interval(share: Estimate) -> str:
    """A proportion with its interval."""
    ends = "" if share.single else f" [{100 * share.low:.1f}, {100 * share.high:.1f}]"
    return f"{100 * share.value:.1f}%{ends}"


def _published(row: Row, paper: Published) -> Iterator[str]:
    for measure in MEASURES:
        value = paper.ratios[measure]
        yield f"{value:.2f}{_mark(row.ratios[measure].mean, value, HALF_CENT)}"
    for share, value in ((row.baseline, paper.baseline), (row.intentional, paper.intentional)):
        yield f"{100 * value:.0f}%{_mark(share, value, HALF_PERCENT)}"


def _mark(ours: Estimate | None, published: float, half_digit: float) -> str:
    outside = ours is not None and ours.covers(published, half_digit) is False
    return OUTSIDE if outside else ""


def _narrow(table: Table) -> Iterator[Cells]:
    """The same for few columns of text: each interval below its value."""
    for cells in rows_of(table):
        values, intervals = zip(*(_parts(cell) for cell in cells), strict=True)
        yield values
        if any(intervals):
            yield ("", *intervals[1:])


def _parts(cell: str) -> tuple[str, str]:
    value, bracket, rest = cell.partition(" [")
    return value, bracket.strip() + rest


def table1_grid(table: Table, title: str) -> Grid:
    """The table for a terminal; its title says what a mark means, where there are any."""
    rows = list(_narrow(table))
    marked = any(cell.endswith(OUTSIDE) for cells in rows for cell in cells)
    return Grid(COLUMNS, rows, range(1, len(COLUMNS)), title + (MARKED if marked else ""))
