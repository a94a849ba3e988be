"""The random pairs as if the released simulator had drawn their events."""

from collections.abc import Iterator, Mapping

from papers.table1 import evidence
from papers.table1.weighing import Weighing
from papers.text import percent, render
from testbed.analysis.bootstrap import Estimate
from testbed.studies.table1.measures import Row
from testbed.studies.table1.published import PUBLISHED, SCENARIOS, Published

NAMES = {"plans": "plans", "execution_units": "exec. time", "actions": "actions"}
"""The measures that do not depend on how fast a machine or a solver is."""
PAIRS = 800
"""About so many paired trials P 4 speaks of, in each of five scenarios."""
DRAWN = 1000


def released(own: Weighing, met_otherwise: int) -> str:
    """The section on the draw of the released simulator.

    `met_otherwise` counts the random pairs whose robots did not meet the same event.
    """
    return render(
        "table1/released",
        met_otherwise=met_otherwise,
        worth=own.worth,
        rows=list(_table(own)),
        names=tuple(NAMES.values()),
        drawn=DRAWN,
        inside=own.inside,
        pairs=PAIRS,
    )


def _table(own: Weighing) -> Iterator[tuple[str, ...]]:
    published, _ = evidence.published_weights()
    for row in own.table.rows:
        paper = PUBLISHED[row.name]
        if row.pairs:
            yield (row.name, _share(own.shares, row), *_ours(row))
            yield ("  published", _share(published, row), *_theirs(row, paper))


def _share(shares: Mapping[str, float], row: Row) -> str:
    return percent(shares[row.name]) if row.name in SCENARIOS else ""


def _ours(row: Row) -> Iterator[str]:
    yield _interval(row.baseline, 100, 1)
    for name in NAMES:
        yield _interval(row.ratios[name].mean, 1, 2)


def _interval(own: Estimate | None, scale: float, digits: int) -> str:
    if own is None:
        return "-"
    value, low, high = (f"{scale * part:.{digits}f}" for part in (own.value, own.low, own.high))
    return f"{value} [{low}, {high}]"


def _theirs(row: Row, paper: Published) -> Iterator[str]:
    missed = {own.column for own in evidence.outside([row], [row.name])}
    yield f"{100 * paper.baseline:.0f}" + " *" * ("accuracy" in missed)
    for name in NAMES:
        yield f"{paper.ratios[name]:.2f}" + " *" * (name in missed)
