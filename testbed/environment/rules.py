"""The rules of a game in a world: its goal, its length, and what the robot is told."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Literal

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
