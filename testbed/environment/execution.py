"""Outcomes of a robot's attempts, and its percepts of the world and of events."""

from collections.abc import Callable, Collection, Iterator, Mapping
from dataclasses import dataclass, field
from itertools import islice

import numpy as np

from asp.language import Action, Fluent, Literal
from asp.refinement import Sensing
from testbed.environment.rules import Observability, Situation
from testbed.protocol import FINISH, WAIT, Event
from testbed.world import World

Statistics = Mapping[str, float]
"""By the name of an action: the probability with which it takes effect; by that of a test: the
probability with which its answer is right. 1 where nothing is said."""


@dataclass(eq=False)
class Execution:
    """The robot's side of a game; `actions` are the robot's besides `wait` and `finish`.

    By `statistics` what is possible may fail to take effect, and the tests of `sensing` may be
    wrong (P 3.3); one of something about the robot itself is always right. With `coarse`, names of
    fluents, exogenous actions happen only beside an action of the robot that changes one of these.
    Raises ValueError for statistics that are none.
    """

    world: World
    robot: str
    sensing: Sensing | None = None
    statistics: Statistics = field(default_factory=dict)
    coarse: Collection[str] | None = None

    def __post_init__(self) -> None:
        self._tests = self.sensing.names if self.sensing else frozenset[str]()
        self.actions: tuple[Action, ...] = self.world.agent_actions
        _check(self.statistics, {*(action.name for action in self.actions), *self._tests})
        if self.sensing:
            self.actions += self.sensing.actions
        names, fluents = self.coarse or (), enumerate(self.world.fluents)
        self._coarse = sum(1 << number for number, fluent in fluents if fluent.name in names)

    def possible(self, state: int, action: Action) -> bool:
        """Whether the robot attempts something, and what can come to anything in the state."""
        if action in (WAIT, FINISH):
            return False
        if self.sensing and not self.physical(action):
            return self.sensing.can(action, self.world.facts(state))
        return self.world.executable(state, (action,))

    def physical(self, action: Action) -> tuple[Action, ...]:
        """What the action contributes to the compound action: itself, or nothing if it looks."""
        return () if action.name in self._tests else (action,)

    def chance(self, action: Action) -> float:
        """The probability with which a possible action takes effect."""
        return self.statistics.get(action.name, 1.0) if self.physical(action) else 1.0

    def sensed(
        self, action: Action, after: int, random: np.random.Generator
    ) -> tuple[Literal, ...]:
        """What an action that took effect shows of the state after it, perhaps wrongly."""
        if not self.sensing or self.physical(action):
            return ()
        fluent = self.sensing.fluent(action)
        certain = self.robot in fluent.arguments
        right = 1.0 if certain else self.statistics.get(action.name, 1.0)
        wrong = right < 1 and random.random() >= right
        return (fluent if self.world.holds(after, fluent) != wrong else fluent.complement,)

    def visible(self, state: int) -> tuple[Literal, ...]:
        """The literals that the robot sees whatever it does."""
        return self.world.visible(state, self.robot)

    def notices(self, state: int, fluents: frozenset[Fluent]) -> bool:
        """Whether the robot is where it could tell whether one of the fluents holds."""
        if self.sensing:
            tests = (self.sensing.test_of(self.robot, fluent) for fluent in fluents)
            facts = self.world.facts(state)
            if any(test is not None and self.sensing.can(test, facts) for test in tests):
                return True
        return not fluents.isdisjoint(each.atom for each in self.visible(state))

    def closed_to_events(self, state: int, action: Action) -> str | None:
        """Why nothing exogenous happens beside the action, if so."""
        if self.coarse is None:
            return None
        after = self.world.successors(state, self.physical(action))
        if any((state ^ other) & self._coarse for other in after):
            return None
        return f"nothing exogenous happens beside {action}, which changes nothing coarse (pace)"


def _check(statistics: Statistics, names: Collection[str]) -> None:
    for name, probability in statistics.items():
        if name not in names:
            known = ", ".join(sorted(names))
            raise ValueError(f"statistics: the robot has no action {name}; there are {known}")
        if not 0 <= probability <= 1:
            raise ValueError(f"statistics: {name}: {probability} does not lie between 0 and 1")


@dataclass(frozen=True)
class Played:
    """A step as it was played: the robot's part of the compound action, and the event, if any.

    `possible` says whether an event might have been instead; by `rules` and `random` the robot is
    told of events.
    """

    execution: Execution
    rules: Mapping[str, Observability]
    random: np.random.Generator
    before: Situation
    effective: tuple[Action, ...]
    event: Action | None
    after: int
    possible: Callable[[Action], bool]

    def reports(self) -> Iterator[tuple[int, Event]]:
        """What the robot is told of the step, truly and falsely, each with the step at which."""
        told = [self.event] if self.event and self._is_told(self.event) else []
        for action in (*told, *self._false_reports()):
            step, late = self.before.step, self.rules[action.name].delay
            yield step + 1 + late, Event(step=step, action=action)

    def _is_told(self, event: Action) -> bool:
        how = self.rules.get(event.name, Observability())
        if how.mode == "never" or (how.mode == "colocated" and not self._witnessed()):
            return False
        return bool(self.random.random() < how.probability)

    def _witnessed(self) -> bool:
        """Whether the robot can tell, before or after, what is as it is because of the event."""
        world, before = self.execution.world, self.before.state
        alone = world.successors(before, self.effective)
        changed = frozenset(world.true_atoms(self.after ^ (*alone, before)[0]))
        return any(self.execution.notices(state, changed) for state in (before, self.after))

    def _false_reports(self) -> Iterator[Action]:
        for name, how in self.rules.items():
            if how.false_reports > 0.0 and self.random.random() < how.false_reports:
                events = self.execution.world.exogenous_actions
                others = [e for e in events if e.name == name and e != self.event]
                drawn = (others[int(number)] for number in self.random.permutation(len(others)))
                yield from islice(filter(self.possible, drawn), 1)
