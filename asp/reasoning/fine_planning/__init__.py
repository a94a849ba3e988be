"""Shortest plans at the fine resolution."""

from asp.reasoning.fine_planning.incremental import Horizons, IncrementalFinePlanner, fine_planner
from asp.reasoning.fine_planning.reference import (
    FinePlan,
    FineStart,
    LiteralProblem,
    NoPlan,
    ReferenceFinePlanner,
)

__all__ = [
    "FinePlan",
    "FineStart",
    "Horizons",
    "IncrementalFinePlanner",
    "LiteralProblem",
    "NoPlan",
    "ReferenceFinePlanner",
    "fine_planner",
]
