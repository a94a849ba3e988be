"""Shortest plans at the coarse resolution: the reference, and incremental planning."""

from asp.reasoning.planning.conformant import ConformantPlanner as ConformantPlanner
from asp.reasoning.planning.conformant import (
    IncrementalConformantPlanner as IncrementalConformantPlanner,
)
from asp.reasoning.planning.conformant import Plans as Plans
from asp.reasoning.planning.conformant import (
    reference_conformant_planner as reference_conformant_planner,
)
from asp.reasoning.planning.incremental import IncrementalPlanner as IncrementalPlanner
from asp.reasoning.planning.large.operators import Encoding as Encoding
from asp.reasoning.planning.large.operators import Operator as Operator
from asp.reasoning.planning.large.operators import Values as Values
from asp.reasoning.planning.reachability import Reachability as Reachability
from asp.reasoning.planning.reference import Plan as Plan
from asp.reasoning.planning.reference import Planner as Planner
from asp.reasoning.planning.reference import ReferencePlanner as ReferencePlanner
