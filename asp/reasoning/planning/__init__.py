"""Shortest plans at the coarse resolution: the reference, and incremental planning."""

from asp.reasoning.planning.incremental import IncrementalPlanner
from asp.reasoning.planning.large.operators import Encoding, Operator, Values
from asp.reasoning.planning.reachability import Reachability
from asp.reasoning.planning.reference import Planner, ReferencePlanner

__all__ = [
    "Encoding",
    "IncrementalPlanner",
    "Operator",
    "Planner",
    "Reachability",
    "ReferencePlanner",
    "Values",
]
