"""Studies: measures of the runs of an experiment, beside its published figures."""

from testbed.studies.charts import Chart as Chart
from testbed.studies.charts import Key as Key
from testbed.studies.charts import Point as Point
from testbed.studies.charts import Series as Series
from testbed.studies.charts import points as points
from testbed.studies.study import Results as Results
from testbed.studies.study import Section as Section
from testbed.studies.study import Study as Study
from testbed.studies.study import left_out as left_out
from testbed.studies.study import results_of as results_of
from testbed.studies.study import study_findings as study_findings
from testbed.studies.tables import Cell as Cell
from testbed.studies.tables import Line as Line
from testbed.studies.tables import Rounded as Rounded
from testbed.studies.tables import Sheet as Sheet
from testbed.studies.tables import Value as Value
from testbed.studies.tables import View as View
from testbed.studies.tables import grid as grid
from testbed.studies.tables import rows_of as rows_of
