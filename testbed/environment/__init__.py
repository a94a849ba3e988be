"""A game between a robot and an adversary in a world, and its PettingZoo environments.

Import `AECView` and `ParallelView` from the modules `aec` and `parallel`: PettingZoo takes longer
to import than all the rest.
"""

from testbed.environment.core import Core
from testbed.environment.execution import Execution
from testbed.environment.fine import Pace, RandomGoal, RandomStart, fine_core
from testbed.environment.rules import (
    ADVERSARY,
    ROBOT,
    Ending,
    IllegalActionError,
    Mode,
    NotResetError,
    Observability,
    Rules,
    UnknownAgentError,
    UnknownOptionError,
    rewards,
)

__all__ = [
    "ADVERSARY",
    "ROBOT",
    "Core",
    "Ending",
    "Execution",
    "IllegalActionError",
    "Mode",
    "NotResetError",
    "Observability",
    "Pace",
    "RandomGoal",
    "RandomStart",
    "Rules",
    "UnknownAgentError",
    "UnknownOptionError",
    "fine_core",
    "rewards",
]
