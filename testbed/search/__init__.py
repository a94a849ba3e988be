"""Searches of a world for what the robot could do in it, by complete knowledge."""

from testbed.search.foresight import least_knowing as least_knowing
from testbed.search.narrowing import Narrowing as Narrowing
from testbed.search.narrowing import coarse_problem as coarse_problem
from testbed.search.plans import BudgetError as BudgetError
from testbed.search.plans import Goal as Goal
from testbed.search.plans import Pose as Pose
from testbed.search.plans import Problem as Problem
from testbed.search.plans import as_it_is as as_it_is
from testbed.search.plans import cheapest_plan as cheapest_plan
from testbed.search.reach import Reach as Reach
