"""The random pairs as if the released simulator had drawn their events."""

from __future__ import annotations

from collections.abc import Iterator, Mapping

from papers.markdown import markdown, paragraph
from papers.table1 import evidence
from papers.table1.weighing import Weighing
from papers.text import percent
from testbed.analysis.statistics import Estimate
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
    columns = ("scenario", "share", "TP acc.", *NAMES.values())
    return f"""\
## The draw of the released simulator

The random event here is what the domain's text says: one of what exogenous actions are done to is
drawn, and if nothing can be done to it, nothing happens at this step. The released simulator
(github.com/hril230/theoryofintentions) does it otherwise in two points. A book that is drawn while
the robot holds it, or is picking it up, passes the draw on to the other book: the event comes
earlier, it moves a book more often than it locks a room, and while one book is on its way it is the
other that is moved, which may be in its place already. And the new room is drawn among all others;
where it is not possible, nothing happens.

{_why(own, met_otherwise)}

{markdown(columns, _table(own))}

{_number(own)}
"""


def _why(own: Weighing, met_otherwise: int) -> str:
    """Why weights do, and how far."""
    doubt = f"In {met_otherwise} pairs they did not meet the same; there it is ATI's event. "
    return paragraph(
        "Until the event both robots know everything, and act alike under either draw. So the "
        "pairs above are pairs of the released simulator, too, only not as frequent: each is "
        "weighed by how many times more probable its event is there "
        f"(`papers/table1/redrawing.py`). {doubt if met_otherwise else ''}What comes "
        f"of it, as certain as {own.worth:.0f} pairs of equal weight:"
    )


def _number(own: Weighing) -> str:
    """How many pairs the published rows are of, as far as it can be told."""
    return paragraph(
        f"Of {DRAWN} pairs so drawn {DRAWN * own.inside:.0f} are of scenarios 1 to 5. The paper "
        f"speaks of about {PAIRS} paired trials in each scenario, which the unequal shares of its "
        "own rows do not bear out."
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
