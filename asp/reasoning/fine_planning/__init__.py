"""Shortest plans at the fine resolution."""

from asp.reasoning.fine_planning.horizon_cache import Horizons
from asp.reasoning.fine_planning.incremental import (
    MOST_STEPS,
    FinePlanner,
    LiteralPlanner,
    fine_planner,
)
from asp.reasoning.fine_planning.reference import (
    FinePlan,
    FineStart,
    NoPlan,
    PlainProblem,
    physical,
)

__all__ = [
    "MOST_STEPS",
    "FinePlan",
    "FinePlanner",
    "FineStart",
    "Horizons",
    "LiteralPlanner",
    "NoPlan",
    "PlainProblem",
    "fine_planner",
    "physical",
]
