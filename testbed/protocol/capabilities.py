"""What a robot can be asked for."""

from collections.abc import Collection
from dataclasses import dataclass
from typing import Literal, TypeAlias, get_args

Resolution: TypeAlias = Literal["coarse", "fine"]
Knowledge: TypeAlias = Literal["complete", "seen"]


@dataclass(frozen=True, kw_only=True)
class Capabilities:
    """What a robot can do, declared as the attribute ``capabilities`` of its class.

    ``resolutions`` are those at which it acts: ``coarse``, and ``fine`` where its task can have a
    refinement. ``knowledge`` are the kinds of knowledge of the initial state that it can begin
    with: ``complete``, and ``seen`` where ``Task.initial`` may leave fluents open.
    ``needs_goal_feedback``: it relies on being told, by ``Percept.goal_holds``, that it finished
    without its goal. ``first_action_step`` is the first step at which it may attempt a physical
    action; a robot that starts an activity by a mental action has 2.

    Raises ValueError for a resolution or a kind of knowledge that there is not.
    """

    resolutions: tuple[Resolution, ...] = ("coarse",)
    knowledge: tuple[Knowledge, ...] = ("complete",)
    needs_goal_feedback: bool = False
    first_action_step: int = 1

    def __post_init__(self) -> None:
        _check("resolutions", self.resolutions, get_args(Resolution))
        _check("knowledge", self.knowledge, get_args(Knowledge))


def _check(name: str, given: Collection[str], known: Collection[str]) -> None:
    if isinstance(given, str) or not set(given) <= set(known):
        raise ValueError(f"{name}: {given!r} should be some of {', '.join(known)}")
