"""Shortest plans at the coarse resolution."""

from asp.reasoning.planning.incremental import IncrementalPlanner
from asp.reasoning.planning.large.operators import Encoding, Operator, Values
from asp.reasoning.planning.reachability import Reachability

__all__ = ["Encoding", "IncrementalPlanner", "Operator", "Reachability", "Values"]
