"""Studies: what is counted of the runs of an experiment, beside what was published of it."""

from testbed.studies.charts import Chart, Colour, Key, Point, Series, points
from testbed.studies.study import Results, Section, Study, left_out, results_of, study_findings
from testbed.studies.tables import Cell, Line, Rounded, Sheet, Value, View, grid, rows_of

__all__ = [
    "Cell",
    "Chart",
    "Colour",
    "Key",
    "Line",
    "Point",
    "Results",
    "Rounded",
    "Section",
    "Series",
    "Sheet",
    "Study",
    "Value",
    "View",
    "grid",
    "left_out",
    "points",
    "results_of",
    "rows_of",
    "study_findings",
]
