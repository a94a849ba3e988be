"""Planning, diagnosis and both, and how far robots are from the optimum, as the page has them."""

from collections.abc import Iterable, Iterator, Sequence
from math import exp, log
from statistics import fmean

from papers.text import render
from testbed.analysis.bootstrap import Estimate
from testbed.studies.table1.measures import Analysis, Row
from testbed.studies.table1.published import PLANNING, PUBLISHED, SCENARIOS
from testbed.studies.table1.tables import OPTIMUM, READINGS, TIMES, optimum_rows, times_rows
from testbed.studies.tables import Cells


def times(analysis: Analysis) -> str:
    """The section on times: a table for each way of drawing, and what the published column is."""
    rows = [row for table in analysis.tables.values() for row in table.rows]
    known = [row for row in rows if row.name in SCENARIOS]
    return render(
        "table1/times",
        columns=TIMES,
        rows=list(_by_way((way, times_rows(table)) for way, table in analysis.tables.items())),
        far=[(name, far) for name in READINGS if (far := _distance(known, name)) is not None],
        reversed=_reversed(analysis),
    )


def optimum(analysis: Analysis) -> str:
    """The section on the optimum: a table for each way of drawing."""
    rows = ((way, optimum_rows(table, analysis.robots)) for way, table in analysis.tables.items())
    return render("table1/optimum", columns=OPTIMUM, rows=list(_by_way(rows)))


def _by_way(tables: Iterable[tuple[str, Iterable[Cells]]]) -> Iterator[Cells]:
    for way, rows in tables:
        yield from ((f"{way}, {cells[0]}", *cells[1:]) for cells in rows)


def _reversed(analysis: Analysis) -> list[str]:
    """The rows in which one mean of ratios is below 1 and the other above it."""
    return [
        f"{way}, {row.name}"
        for way, table in analysis.tables.items()
        for row in table.rows
        if row.pairs and _disagree(*(row.times[name].ratio.mean for name in READINGS))
    ]


def _disagree(one: Estimate | None, other: Estimate | None) -> bool:
    return one is not None and other is not None and (one.value - 1) * (other.value - 1) < 0


def _distance(rows: Sequence[Row], name: str) -> float | None:
    """The geometric mean of how many times ours is the published value, or the reverse."""
    means = [(row.name, row.times[name].ratio.mean) for row in rows if row.pairs]
    logs = [
        abs(log(mean.value / PUBLISHED[row].ratios[PLANNING]))
        for row, mean in means
        if mean is not None and mean.value
    ]
    return exp(fmean(logs)) if logs else None
