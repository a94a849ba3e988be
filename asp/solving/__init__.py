"""Solving programs with clingo, within a budget, in one call or over many."""

from asp.solving.budget import UNLIMITED, BudgetError, LimitError, Limits, current, deciding, up_to
from asp.solving.cache import Answers, Recent
from asp.solving.clock import Reading, preparation, reasoning_clock
from asp.solving.session import (
    Session,
    State,
    assumptions,
    core,
    goal_externals,
    preferring,
    state_of,
)
from asp.solving.signals import undisturbed
from asp.solving.solver import (
    answer_sets,
    fact,
    first_model,
    ground,
    is_satisfiable,
    literal_of,
    optimal_model,
    select,
    solving,
    theory,
)

__all__ = [
    "UNLIMITED",
    "Answers",
    "BudgetError",
    "LimitError",
    "Limits",
    "Reading",
    "Recent",
    "Session",
    "State",
    "answer_sets",
    "assumptions",
    "core",
    "current",
    "deciding",
    "fact",
    "first_model",
    "goal_externals",
    "ground",
    "is_satisfiable",
    "literal_of",
    "optimal_model",
    "preferring",
    "preparation",
    "reasoning_clock",
    "select",
    "solving",
    "state_of",
    "theory",
    "undisturbed",
    "up_to",
]
