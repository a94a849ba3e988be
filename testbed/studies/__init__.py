"""Studies: what is counted of the runs of an experiment, beside what was published of it."""

from testbed.studies.charts import Chart, Colour, Key, Point, Series, points
from testbed.studies.pairs import Ratio, Sample, joined
from testbed.studies.study import (
    STUDIES,
    Results,
    Section,
    Study,
    left_out,
    results_of,
    study_findings,
)
from testbed.studies.tables import Cell, Line, Rounded, Sheet, Value, View, grid, rows_of

__all__ = [
    "STUDIES",
    "Cell",
    "Chart",
    "Colour",
    "Key",
    "Line",
    "Point",
    "Ratio",
    "Results",
    "Rounded",
    "Sample",
    "Section",
    "Series",
    "Sheet",
    "Study",
    "Value",
    "View",
    "grid",
    "joined",
    "left_out",
    "points",
    "results_of",
    "rows_of",
    "study_findings",
]
