"""How a robot's attempts come out, and what the robot perceives of it."""

from __future__ import annotations

from typing import Protocol

import numpy as np

from asp.language import literals as text
from testbed.world import World


class Execution(Protocol):
    """The robot's side of a game; `actions` are the robot's besides `wait` and `finish`."""

    robot: str
    actions: tuple[str, ...]

    def possible(self, state: int, action: str, /) -> bool:
        """Whether an attempt can come to anything in the state."""

    def physical(self, action: str, /) -> tuple[str, ...]:
        """What the action contributes to the compound action: itself, or nothing if it looks."""

    def chance(self, action: str, /) -> float:
        """The probability with which a possible action takes effect."""

    def sensed(self, action: str, after: int, random: np.random.Generator, /) -> tuple[str, ...]:
        """What an action that took effect shows of the state after it, perhaps wrongly."""

    def visible(self, state: int, /) -> tuple[str, ...]:
        """The literals that the robot sees whatever it does."""

    def notices(self, state: int, fluents: frozenset[str], /) -> bool:
        """Whether the robot is where it could tell whether one of the fluents holds."""

    def closed_to_events(self, state: int, action: str, /) -> str | None:
        """Why nothing exogenous happens beside the action, if so."""


class Exact:
    """What is possible takes effect."""

    def __init__(self, world: World, robot: str) -> None:
        self._world = world
        self.robot = robot
        self.actions = world.agent_actions

    def possible(self, state: int, action: str, /) -> bool:
        return self._world.executable(state, (action,))

    def physical(self, action: str, /) -> tuple[str, ...]:
        return (action,)

    def chance(self, _action: str, /) -> float:
        return 1.0

    def sensed(self, _action: str, _after: int, _random: np.random.Generator, /) -> tuple[str, ...]:
        return ()

    def visible(self, state: int, /) -> tuple[str, ...]:
        return self._world.visible(state, self.robot)

    def notices(self, state: int, fluents: frozenset[str], /) -> bool:
        return not fluents.isdisjoint(map(text.atom, self.visible(state)))

    def closed_to_events(self, _state: int, _action: str, /) -> str | None:
        return None
