"""The environment's two agents, and the reading of their answers."""

from __future__ import annotations

from collections.abc import Sequence
from operator import index
from typing import SupportsIndex

from testbed.environment.errors import IllegalActionError, UnknownAgentError

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
