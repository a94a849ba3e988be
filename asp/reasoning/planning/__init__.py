"""Shortest plans at the coarse resolution: the reference, and incremental planning."""

from asp.reasoning.planning.incremental import IncrementalPlanner as IncrementalPlanner
from asp.reasoning.planning.large.operators import Encoding as Encoding
from asp.reasoning.planning.large.operators import Operator as Operator
from asp.reasoning.planning.large.operators import Values as Values
from asp.reasoning.planning.reachability import Reachability as Reachability
from asp.reasoning.planning.reference import Plan as Plan
from asp.reasoning.planning.reference import Planner as Planner
from asp.reasoning.planning.reference import ReferencePlanner as ReferencePlanner
