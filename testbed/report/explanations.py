"""How well the robots of a run explained, as a table: one row per scenario, or level, and robot."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any, NamedTuple

from testbed.analysis.quality import OF, SHARES
from testbed.report.comparison import groups_of
from testbed.studies.explanations import EXPLANATIONS
from testbed.text import chance

SELDOM = ("false_exceptions", "wrongly_distrusted")
"""Columns that are left out where nothing is in them."""


class Number(NamedTuple):
    """A cell: a value, and below it how large the difference of the robots is, and p."""

    text: str
    note: str = ""


@dataclass(frozen=True)
class Row:
    """What a robot explained in a scenario: the numbers of the summary, and the tests if any."""

    place: str
    robot: str
    numbers: Mapping[str, Any]
    tests: Mapping[str, Any] | None

    def cell(self, name: str) -> Number:
        """A number as text: a share with what it is of, a mean."""
        value = self.numbers[name]
        if value is None:
            return Number("-")
        of = f" % of {self.numbers[OF[name]]}" if name in SHARES else ""
        text = f"{100 * value if of else value:.1f}{of}"
        if self.tests is None or self.tests["holm"][name] is None:
            return Number(text)
        return Number(
            text, f"{self.tests['effects'][name]:+.2f} ({chance(self.tests['holm'][name])})"
        )


class Table(NamedTuple):
    """The headings of the numbers, and by row its scenario, its robot and its numbers."""

    headings: Sequence[str]
    rows: Sequence[tuple[str, str, Sequence[Number]]]


def quality_table(summary: Mapping[str, Any]) -> Table | None:
    """The table of a summary; None where there was nothing to explain.

    Effects and p-values stand in the rows of the treatment.
    """
    rows = [
        Row(place, robot, own, _tests(group, robot == summary["treatment"]))
        for place, group in (groups_of(summary) or summary["scenarios"]).items()
        for robot, own in group["explanations"].items()
        if own["unobserved"] or own["adopted"]
    ]
    if not rows:
        return None
    named = [n for n in EXPLANATIONS if n not in SELDOM or any(r.numbers[OF[n]] for r in rows)]
    cells = [(row.place, row.robot, [row.cell(name) for name in named]) for row in rows]
    return Table([EXPLANATIONS[name].title for name in named], cells)


def _tests(group: Mapping[str, Any], is_treatment: bool) -> Mapping[str, Any] | None:
    """The tests of a group of several pairs."""
    found: Mapping[str, Any] = group["explanation_tests"]
    return found if is_treatment and group["pairs"] > 1 else None
