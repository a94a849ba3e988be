"""How far both robots of Table 1 are from the optimum: what they needed, over the least."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence

from testbed.analysis.optimum import Needed, Optimum, optimum
from testbed.studies.table1.pairing import Pair, Side
from testbed.studies.table1.results import Analysis, Row, Table
from testbed.text.markdown import markdown

COLUMNS = (
    "scenario",
    "TP trials",
    "TP units",
    "TP actions",
    "ATI trials",
    "ATI units",
    "ATI actions",
)

INTRODUCTION = """\
## How far from the optimum

What a robot needed, divided by the least that achieves the goal from the same initial state with
complete knowledge where nothing exogenous happens: means over the trials that achieved the goal, of
execution units and of actions. 1.00 is the optimum. Below it is a robot that was helped on the way,
as in scenario 2; above it is what the exogenous action cost, and what was done in vain. Trials of
TP that did not achieve the goal are in no mean: where they are many, its number says little.
"""


def both_optima(pairs: Sequence[Pair], weights: Mapping[str, float]) -> tuple[Optimum, Optimum]:
    """Of the intentional robot, and of the traditional one, over pairs that count.

    `weights`: what a pair weighs, by the scenario that was played.
    """
    return (
        optimum(_needed(pair, pair.mind, weights) for pair in pairs if pair.mind.achieved),
        optimum(_needed(pair, pair.base, weights) for pair in pairs if pair.base.achieved),
    )


def _needed(pair: Pair, side: Side, weights: Mapping[str, float]) -> Needed:
    return Needed(side.measures, pair.minimal, weights[pair.intended])


def section(analysis: Analysis) -> str:
    """The section of a page: a table for each way of drawing."""
    both = (("triggered", analysis.triggered), ("random", analysis.random))
    rows = [
        (f"{way}, {cells[0]}", *cells[1:])
        for way, table in both
        if table is not None
        for cells in rows_of(table, analysis.mind, analysis.base)
    ]
    return f"{INTRODUCTION}\n{markdown(COLUMNS, rows)}\n"


def rows_of(table: Table, mind: str, base: str) -> Iterator[tuple[str, ...]]:
    """Under COLUMNS: for each row with pairs how far its robots are from the optimum."""
    for row in table.rows:
        if row.pairs and {mind, base} <= set(row.optimum):
            yield (row.name, *_cells(row, base), *_cells(row, mind))


def _cells(row: Row, robot: str) -> tuple[str, ...]:
    own = row.optimum[robot]
    return (str(own.trials), *(_ratio(value) for value in (own.execution_units, own.actions)))


def _ratio(value: float | None) -> str:
    return "-" if value is None else f"{value:.2f}"
