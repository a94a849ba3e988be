"""The history of an intentional agent (D 2.3), with the activities it has built."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field

from clingo import Symbol

from asp.reasoning import diagnosis
from asp.reasoning.diagnosis import GOAL
from asp.solving import fact


@dataclass(frozen=True)
class Activity:
    """A plan made for the goal: its name (1, 2, ...) and its physical actions."""

    name: int
    plan: tuple[str, ...]


@dataclass
class History(diagnosis.History):
    """What was observed and attempted at each step, and every activity so far."""

    activities: list[Activity] = field(default_factory=list)

    def activity_facts(self) -> Iterator[Symbol]:
        """What the theory knows of each activity: its goal, its components, its length."""
        for activity in self.activities:
            yield fact("activity_goal", activity.name, GOAL)
            yield fact("activity_length", activity.name, len(activity.plan))
            for index, action in enumerate(activity.plan, start=1):
                yield fact("activity_component", activity.name, index, action)

    @property
    def longest(self) -> int:
        """The length of the longest plan so far."""
        return max((len(activity.plan) for activity in self.activities), default=0)
