"""What the study of the levels finds in records."""

from collections.abc import Iterable
from typing import Any

from testbed.analysis.table import table_of
from testbed.experiment.record import TrialRecord
from testbed.studies.levels.measures import Levels, analyse
from testbed.studies.levels.numbers import numbers
from testbed.studies.levels.published import OWN, Paper
from testbed.studies.levels.tables import sections
from testbed.studies.tables import View


def found(records: Iterable[TrialRecord], paper: Paper = OWN) -> Levels:
    """The columns of the levels, beside what was published."""
    return Levels(analyse(table_of(records)), paper)


def columns(records: Iterable[TrialRecord], paper: Paper = OWN) -> dict[str, Any]:
    """What is added to a summary, by level."""
    added: dict[str, Any] = numbers(found(records, paper))["levels"]
    return added


def views(records: Iterable[TrialRecord], paper: Paper = OWN) -> dict[str, View]:
    """The tables of the report, by name."""
    (section,) = sections(found(records, paper))
    return {view.name: view for view in section.views}
