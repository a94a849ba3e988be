"""What an agent remembers: the history of spec 2, and the activities it has built."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass, field

from clingo import Symbol

from asp.literals import atom, is_positive
from asp.solving import fact
from testbed.link.messages import Event

GOAL = "my_goal"


@dataclass(frozen=True)
class Activity:
    """A plan made for the goal: its name (1, 2, ...) and its physical actions."""

    name: int
    plan: tuple[str, ...]


@dataclass
class History:
    """Statements obs, hpd and attempt of all steps up to `step`, as facts for the theory."""

    step: int = 0
    activities: list[Activity] = field(default_factory=list)
    _recorded: dict[Symbol, None] = field(default_factory=dict)

    def observe(self, literals: Iterable[str], step: int) -> None:
        """obs(F,B,I) for each literal."""
        for literal in literals:
            self._record("obs", atom(literal), _truth(is_positive(literal)), step)

    def happened(self, action: str, truth: bool, step: int) -> None:
        """hpd(A,B,I)."""
        self._record("hpd", action, _truth(truth), step)

    def attempt(self, action: str, step: int) -> None:
        """attempt(A,I)."""
        self._record("attempt", action, step)

    def facts(self) -> Iterator[Symbol]:
        """The history in the order in which it was recorded, without the activities."""
        yield from self._recorded
        yield fact("current_step", self.step)

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

    def _record(self, predicate: str, *arguments: str | int) -> None:
        self._recorded.setdefault(fact(predicate, *arguments))


@dataclass(frozen=True)
class Diagnosis:
    """An explanation of a history: the exogenous events that nobody reported."""

    unobserved: tuple[Event, ...] = ()

    def facts(self, predicate: str) -> Iterator[Symbol]:
        """predicate(PEA,I) for each event."""
        for event in self.unobserved:
            yield fact(predicate, event.action, event.step)


def _truth(value: bool) -> str:
    return "true" if value else "false"
