"""The coarse transition diagram as the executor asks about it, in the names of the whole task."""

from __future__ import annotations

from collections.abc import Iterable

from agents.intentional.abstraction import Leaned
from agents.shared.knowledge import knowledge
from agents.shared.sessions import tools_of

State = frozenset[str]


class CoarseDiagram:
    """The transitions of what is left of a task, and the fluents that they are about."""

    def __init__(self, leaned: Leaned) -> None:
        self._leaned = leaned
        self._knowledge = knowledge(leaned.task.domain, leaned.task.source)
        description = self._knowledge.description
        self.fluents = tuple(leaned.back(description.fluents))
        self.inertial = tuple(leaned.back(description.inertial))
        self.robot = leaned.constant(description.robots[0])

    def after(self, state: State, action: str | None, events: Iterable[str]) -> State | None:
        """The next state, where the action and the events occur together; None: they cannot."""
        leaned = self._leaned
        attempt = None if action is None else leaned.seen([action])[0]
        transitions = tools_of(self._knowledge).transitions
        found = transitions.after(
            frozenset(leaned.seen(state)), attempt, tuple(leaned.seen(events))
        )
        if found is None or (action is not None and not found[1]):
            return None
        return frozenset(leaned.back(found[0]))

    def news(self, state: State, action: str | None, events: Iterable[str]) -> list[str]:
        """Those of the events, told in this order, that can have occurred with the action.

        An event that undoes an earlier one takes its place; one that changes nothing is no event.
        """
        found: list[str] = []
        for event in self.about(events):
            if self.after(state, action, [event]) is not None:
                found.append(event)
                while self.after(state, action, found) is None:
                    found.pop(0)
        return found

    def about(self, events: Iterable[str]) -> list[str]:
        """Those of the events that are about what is left of the task."""
        return list(filter(self._leaned.is_about, events))
