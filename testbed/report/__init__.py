"""The report of a run: tables, figures, explanations, and the trials to look into."""

from testbed.report.page import Tables, write_report
from testbed.report.stories import SHOWN
from testbed.report.tables import grid

__all__ = ["SHOWN", "Tables", "grid", "write_report"]
