"""Table 1 (P 4): two robots from the same initial states, under the same exogenous actions."""

from testbed.studies.study import Study
from testbed.studies.table1.measures import Analysis, measures
from testbed.studies.table1.numbers import numbers
from testbed.studies.table1.tables import sections

STUDY: Study[list[Analysis]] = Study(measures, numbers, sections, published="table1", compares=True)
