"""The environment's two agents, and the reading of their answers."""

from __future__ import annotations

from collections.abc import Sequence
from typing import SupportsIndex

from testbed.environment.errors import IllegalActionError

ROBOT, ADVERSARY = "robot_0", "adversary_0"


def name_of(agent: str, answer: object, actions: Sequence[str]) -> str:
    """The action of an agent's answer, an index. Raises IllegalActionError naming the actions."""
    if isinstance(answer, SupportsIndex) and not isinstance(answer, bool):
        index = answer.__index__()
        if 0 <= index < len(actions):
            return actions[index]
    raise IllegalActionError(f"{agent}: {answer!r} is not an action; there are {listed(actions)}")


def listed(actions: Sequence[str], legal: Sequence[str] | None = None) -> str:
    """The actions, or the legal ones among them, with their indices."""
    chosen = actions if legal is None else legal
    return ", ".join(f"{i} {action}" for i, action in enumerate(actions) if action in chosen)
