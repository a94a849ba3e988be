"""Comparisons of any two contestants as a table for a terminal."""

from collections.abc import Iterable

from testbed.analysis.contestants import Contrast
from testbed.analysis.statistics import Test
from testbed.studies.tables import Cell, effect
from testbed.text.grid import Grid

COLUMNS = {"execution_units": "exec. units", "actions": "actions", "planning_time": "planning"}
"""The measures that are shown, by what their columns are called."""


def grid(found: Iterable[Contrast]) -> Grid:
    """One line per comparison and place."""
    heads = ("treatment / baseline", "in", "pairs", "baseline achieves", "treatment achieves")
    rows = [
        (
            f"{own.names.treatment} against {own.names.baseline}",
            f"{own.place} under {own.condition}" if own.condition else own.place,
            str(own.pairs),
            Cell(own.baseline, share=True).value.whole,
            Cell(own.treatment, share=True).value.whole + _tested(own.test),
            *(
                Cell(own.ratios[name].mean).value.whole + _tested(own.ratios[name].test)
                for name in COLUMNS
            ),
        )
        for own in found
    ]
    ratios = (f"{name}, baseline / treatment" for name in COLUMNS.values())
    return Grid((*heads, *ratios), rows, numbers=range(2, 3))


def _tested(test: Test | None) -> str:
    return "" if test is None else f" ({effect(test)})"
