"""What an ending is worth. The robot and the adversary play a zero-sum game."""

from __future__ import annotations

from testbed.environment.agents import ADVERSARY, ROBOT
from testbed.environment.situation import Ending


def rewards(ending: Ending | None) -> dict[str, float]:
    """The robot gets 1 for the goal achieved, -1 for any other end, 0 while the game goes on."""
    if ending is None:
        return {ROBOT: 0.0, ADVERSARY: 0.0}
    value = 1.0 if ending is Ending.ACHIEVED else -1.0
    return {ROBOT: value, ADVERSARY: -value}
