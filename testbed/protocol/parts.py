"""What messages have in common: parts, actions at a step, actions with a meaning of their own."""

import msgspec

from asp.language import Action, Literal
from testbed.protocol.bounds import Count

WAIT, FINISH, NONE = map(Action.of, ("wait", "finish", "none"))
"""The actions that are the environment's own: of the robot, and of the adversary."""


def is_mental(action: Action) -> bool:
    """Whether an action starts or stops an activity: `start(N)`, `stop(N)`."""
    parts = action.arguments
    number = parts[0] if len(parts) == 1 else ""
    is_named = action.is_positive and action.name in ("start", "stop")
    return is_named and number.isdecimal() and len(number) < 10


class Part(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """Something that travels inside a message."""


class Event(Part, frozen=True, kw_only=True):
    """An action at a step of the history."""

    step: Count
    action: Literal
