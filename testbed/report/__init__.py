"""The report of a run: tables, figures, explanations, and the trials to look into."""

from testbed.report.page import Tables, write_report
from testbed.report.stories import SHOWN, Chapter, Step, Story, timeline

__all__ = ["SHOWN", "Chapter", "Step", "Story", "Tables", "timeline", "write_report"]
