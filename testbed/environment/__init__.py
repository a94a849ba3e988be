"""A game between a robot and an adversary in a world, and its PettingZoo environments."""

from importlib import import_module
from typing import TYPE_CHECKING, Any

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
from testbed.protocol import FINISH, NONE, WAIT

if TYPE_CHECKING:
    from testbed.environment.aec import AECView, OrderedView
    from testbed.environment.parallel import ParallelView

__all__ = [
    "ADVERSARY",
    "FINISH",
    "NONE",
    "ROBOT",
    "WAIT",
    "AECView",
    "Core",
    "Ending",
    "Execution",
    "IllegalActionError",
    "Mode",
    "NotResetError",
    "Observability",
    "OrderedView",
    "Pace",
    "ParallelView",
    "RandomGoal",
    "RandomStart",
    "Rules",
    "UnknownAgentError",
    "UnknownOptionError",
    "fine_core",
    "rewards",
]

_VIEWS = {"AECView": "aec", "OrderedView": "aec", "ParallelView": "parallel"}
"""Imported when they are asked for: PettingZoo takes longer to import than all the rest."""


def __getattr__(name: str) -> Any:
    if name not in _VIEWS:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    return getattr(import_module(f"{__name__}.{_VIEWS[name]}"), name)
