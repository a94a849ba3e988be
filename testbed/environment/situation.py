"""The moment of a game: what a step changes, and how a game ends."""

from __future__ import annotations

from dataclasses import dataclass
from enum import StrEnum
from typing import Any

from testbed.protocol.messages import Event


class Ending(StrEnum):
    """How a game ended; the values are those of a trial's `outcome`."""

    ACHIEVED = "achieved"
    FALSE_FINISH = "false_finish"
    STEP_LIMIT = "step_limit"

    @property
    def by_answer(self) -> bool:
        """Whether the robot ended the game (a termination), not the clock (a truncation)."""
        return self is not Ending.STEP_LIMIT


@dataclass(frozen=True)
class Situation:
    """Everything about a running game that changes.

    `answer` and `event` are what both agents did at the step before (None at step 1), `happened`
    whether the robot's action took effect (None if it waited or finished), `sensed` the literals
    that it showed; `told` is the news that reaches the robot now, `pending` news with the step at
    which it will; `goal_holds` is False after a `finish` that was answered, else None.
    """

    trial: str
    step: int
    state: int
    goal: tuple[str, ...]
    answer: str | None = None
    happened: bool | None = None
    event: str | None = None
    sensed: tuple[str, ...] = ()
    told: tuple[Event, ...] = ()
    pending: tuple[tuple[int, Event], ...] = ()
    goal_holds: bool | None = None
    ending: Ending | None = None


@dataclass(frozen=True)
class Snapshot:
    """A situation with the state of the random generator: all that a game's future depends on."""

    situation: Situation
    generator: Any
