"""Searches of a world: plans of the robot, by complete knowledge."""

from testbed.search.narrowing import Narrowing as Narrowing
from testbed.search.plans import BudgetError as BudgetError
from testbed.search.plans import Goal as Goal
from testbed.search.plans import Problem as Problem
from testbed.search.plans import cheapest_plan as cheapest_plan
