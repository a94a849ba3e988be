"""The rules of a game in a world, what a step of it changes, and how it ends."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from enum import StrEnum
from typing import Any, Literal

from testbed.protocol import Event

Mode = Literal["never", "colocated", "always"]


@dataclass(frozen=True)
class Observability:
    """Whether the robot is told of an exogenous action: `probability` is drawn each time.

    `colocated`: only if the robot sees, before or after the step, a fluent that the action changed.
    With probability `false_reports` a step, the robot is told of one that did not happen, though it
    was possible. News, true or false, comes `delay` steps late.
    """

    mode: Mode = "never"
    probability: float = 1.0
    false_reports: float = 0.0
    delay: int = 0


@dataclass(frozen=True)
class Rules:
    """`steps` is the number of the last step at which the robot may answer, the first being 1.

    `observability` is by the name of the exogenous action; one left out is never observed. With
    `goal_feedback` the first of two consecutive wrong `finish` is answered instead of ending the
    game. Unless `exogenous_while_thinking`, nothing exogenous happens while the robot waits.
    """

    goal: tuple[str, ...]
    steps: int = 100
    observability: Mapping[str, Observability] = field(default_factory=dict)
    goal_feedback: bool = True
    exogenous_while_thinking: bool = False


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
