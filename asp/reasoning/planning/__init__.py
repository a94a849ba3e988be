"""Shortest plans at the coarse resolution."""

from asp.reasoning.planning.incremental import Plans
from asp.reasoning.planning.large.operators import Encoding, Operator, Values
from asp.reasoning.planning.reachability import Reach
from asp.reasoning.planning.relevance import Independence

__all__ = ["Encoding", "Independence", "Operator", "Plans", "Reach", "Values"]
