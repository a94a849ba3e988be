"""What an adversary is: it sees everything, the robot's chosen action included."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Protocol


@dataclass(frozen=True)
class AdversaryView:
    """What an adversary sees before it answers.

    `state` are the true fluents, `robot_action` what the robot will attempt at this step, `legal`
    what may be answered: `none`, and the exogenous actions possible beside the robot's. Where these
    are many, asking whether one is legal is quick, and listing all is not. `physical`: whether the
    robot's action is one that is to change the world, and not a mental action or a test.
    """

    step: int
    state: frozenset[str]
    robot_action: str
    legal: Sequence[str]
    physical: bool = True


class Adversary(Protocol):
    """One adversary over many trials."""

    def reset(self, seed: int) -> None:
        """Begins a trial; everything drawn in it follows from the seed."""

    def act(self, view: AdversaryView) -> str:
        """The answer at a step: `none` or a ground exogenous action."""
