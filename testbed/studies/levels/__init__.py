"""The levels L1 to L8 and other maps (P 4, Tables 2 and 3): reasoning with zooming, and without."""

from testbed.studies.levels.measures import Levels, measures
from testbed.studies.levels.numbers import numbers
from testbed.studies.levels.tables import sections
from testbed.studies.study import Study

STUDY: Study[Levels] = Study(measures, numbers, sections, fine=True, published="levels", every=True)
