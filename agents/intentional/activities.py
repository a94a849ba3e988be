"""Activities (D 1.3), and histories with them."""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field, replace
from typing import Self

from clingo import Symbol

from asp.language import Action
from asp.reasoning import diagnosis
from asp.reasoning.diagnosis import GOAL
from asp.solving import fact


@dataclass(frozen=True)
class Activity:
    """A plan made for the goal: its name (1, 2, ...) and its physical actions."""

    name: int
    plan: tuple[Action, ...]


def start_activity(name: int) -> Action:
    """The mental action of starting an activity."""
    return Action.of("start", (str(name),))


def stop_activity(name: int) -> Action:
    """The mental action of stopping an activity."""
    return Action.of("stop", (str(name),))


@dataclass
class History(diagnosis.History):
    """What was observed and attempted at each step, and every activity so far."""

    activities: list[Activity] = field(default_factory=list)

    def copy(self) -> Self:
        return replace(super().copy(), activities=[*self.activities])

    def activity_facts(self) -> Iterator[Symbol]:
        """What the theory knows of each activity: its goal, its components, its length."""
        for activity in self.activities:
            yield fact("activity_goal", activity.name, GOAL)
            yield fact("activity_length", activity.name, len(activity.plan))
            for index, action in enumerate(activity.plan, start=1):
                yield fact("activity_component", activity.name, index, action)

    def left(self, indices: Mapping[int, int]) -> tuple[Action, ...]:
        """What is left of the plan of the activity that is carried out; nothing without one."""
        for name, index in indices.items():
            return self.activities[name - 1].plan[index:]
        return ()

    @property
    def longest(self) -> int:
        """The length of the longest plan so far."""
        return max((len(activity.plan) for activity in self.activities), default=0)
