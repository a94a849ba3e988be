"""How a robot's attempts come out, and what the robot perceives of it."""

from __future__ import annotations

from collections.abc import Collection, Mapping
from typing import Literal

import numpy as np

from asp.language import Action
from asp.language import literals as text
from testbed.world import Sensing, World

Statistics = Mapping[str, float]
"""By the name of an action: the probability with which it takes effect; by that of a test: the
probability with which its answer is right. 1 where nothing is said."""

Pace = Literal["concrete", "abstract"]
"""When exogenous actions may happen: at each step, or only beside an action of the robot that
changes what holds at the coarse resolution."""


class Execution:
    """The robot's side of a game, in which what is possible takes effect.

    `actions` are the robot's besides `wait` and `finish`.
    """

    def __init__(self, world: World, robot: str) -> None:
        self._world = world
        self.robot = robot
        self.actions: tuple[Action, ...] = world.agent_actions

    def possible(self, state: int, action: str) -> bool:
        """Whether an attempt can come to anything in the state."""
        return self._world.executable(state, (action,))

    def physical(self, action: str) -> tuple[str, ...]:
        """What the action contributes to the compound action: itself, or nothing if it looks."""
        return (action,)

    def chance(self, _action: str) -> float:
        """The probability with which a possible action takes effect."""
        return 1.0

    def sensed(self, _action: str, _after: int, _random: np.random.Generator) -> tuple[str, ...]:
        """What an action that took effect shows of the state after it, perhaps wrongly."""
        return ()

    def visible(self, state: int) -> tuple[str, ...]:
        """The literals that the robot sees whatever it does."""
        return self._world.visible(state, self.robot)

    def notices(self, state: int, fluents: frozenset[str]) -> bool:
        """Whether the robot is where it could tell whether one of the fluents holds."""
        return not fluents.isdisjoint(map(text.atom, self.visible(state)))

    def closed_to_events(self, _state: int, _action: str) -> str | None:
        """Why nothing exogenous happens beside the action, if so."""
        return None


class UncertainExecution(Execution):
    """Actions that may fail, and tests that may be wrong (P 3.3).

    What holds after an action has to be tested: the robot sees only whether it took effect. A test
    of something about the robot itself is always right. `coarse` are the names of the fluents of
    the coarse resolution. Raises ValueError for statistics that are none.
    """

    def __init__(
        self,
        world: World,
        sensing: Sensing,
        robot: str,
        statistics: Statistics,
        coarse: Collection[str],
        pace: Pace = "concrete",
    ) -> None:
        super().__init__(world, robot)
        self._sensing = sensing
        self.actions = (*world.agent_actions, *sensing.actions)
        _check(statistics, {*map(text.name, world.agent_actions), *sensing.names})
        self._statistics = statistics
        self._paced = pace == "abstract"
        names = [text.name(fluent) in coarse for fluent in world.fluents]
        self._coarse = sum(1 << number for number, is_coarse in enumerate(names) if is_coarse)

    def possible(self, state: int, action: str) -> bool:
        if text.name(action) in self._sensing.names:
            return self._sensing.can(state, action)
        return super().possible(state, action)

    def physical(self, action: str) -> tuple[str, ...]:
        return () if text.name(action) in self._sensing.names else (action,)

    def chance(self, action: str) -> float:
        physical = self.physical(action)
        return self._statistics.get(text.name(action), 1.0) if physical else 1.0

    def sensed(self, action: str, after: int, random: np.random.Generator) -> tuple[str, ...]:
        if self.physical(action):
            return ()
        fluent = self._sensing.fluent(action)
        right = 1.0
        if self.robot not in text.arguments(fluent):
            right = self._statistics.get(text.name(action), 1.0)
        holds = self._world.satisfies(after, (fluent,))
        if right < 1 and random.random() >= right:
            holds = not holds
        return (fluent if holds else text.complement(fluent),)

    def notices(self, state: int, fluents: frozenset[str]) -> bool:
        tests = (self._sensing.test_of(self.robot, fluent) for fluent in fluents)
        if any(test is not None and self._sensing.can(state, test) for test in tests):
            return True
        return super().notices(state, fluents)

    def closed_to_events(self, state: int, action: str) -> str | None:
        if not self._paced or self._changes_the_coarse(state, action):
            return None
        return f"nothing exogenous happens beside {action}, which changes nothing coarse (pace)"

    def _changes_the_coarse(self, state: int, action: str) -> bool:
        after = self._world.successors(state, self.physical(action))
        return any((state ^ other) & self._coarse for other in after)


def _check(statistics: Statistics, names: Collection[str]) -> None:
    for name, probability in statistics.items():
        if name not in names:
            known = ", ".join(sorted(names))
            raise ValueError(f"statistics: the robot has no action {name}; there are {known}")
        if not 0 <= probability <= 1:
            raise ValueError(f"statistics: {name}: {probability} does not lie between 0 and 1")
