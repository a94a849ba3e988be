"""The environment's two agents: the reading of their answers, and their rewards."""

from __future__ import annotations

from collections.abc import Sequence
from operator import index
from typing import SupportsIndex

from testbed.environment.errors import IllegalActionError, UnknownAgentError
from testbed.environment.rules import Ending

ROBOT, ADVERSARY = "robot_0", "adversary_0"


def name_of(agent: str, answer: object, actions: Sequence[str]) -> str:
    """The action of an agent's answer, an index. Raises IllegalActionError naming the actions."""
    number = _index(answer)
    if number is not None and 0 <= number < len(actions):
        return actions[number]
    raise IllegalActionError(f"{agent}: {answer!r} is not an action; there are {listed(actions)}")


def _index(answer: object) -> int | None:
    """An integer of any type, also of NumPy's; None for anything else, such as an array of one."""
    if isinstance(answer, bool) or not isinstance(answer, SupportsIndex):
        return None
    try:
        return index(answer)
    except TypeError:
        return None


def check_agent(agent: str) -> None:
    """Raises UnknownAgentError for a name that is neither agent's."""
    if agent not in (ROBOT, ADVERSARY):
        raise UnknownAgentError(f"{agent!r} is not an agent; there are {ROBOT} and {ADVERSARY}")


def listed(actions: Sequence[str], legal: Sequence[str] | None = None) -> str:
    """The actions, or the legal ones among them, with their indices."""
    chosen = actions if legal is None else legal
    return ", ".join(f"{i} {action}" for i, action in enumerate(actions) if action in chosen)


def rewards(ending: Ending | None) -> dict[str, float]:
    """What an ending is worth, in a zero-sum game.

    The robot gets 1 for the goal achieved, -1 for any other end, 0 while the game goes on.
    """
    if ending is None:
        return {ROBOT: 0.0, ADVERSARY: 0.0}
    value = 1.0 if ending is Ending.ACHIEVED else -1.0
    return {ROBOT: value, ADVERSARY: -value}
