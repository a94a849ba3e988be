"""The report of a run: tables, figures, explanations, and the trials to look into."""

from testbed.report.page import Report as Report
from testbed.report.page import Tables as Tables
from testbed.report.page import write_report as write_report
from testbed.report.page import written_report as written_report
from testbed.report.stories import SHOWN as SHOWN
from testbed.report.tables import grid as grid
