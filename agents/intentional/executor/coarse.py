"""The coarse resolution: its transitions, and what the coarse robot is told of the fine one."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass

from agents.intentional.abstraction import AbstractTask
from agents.intentional.executor.belief import Mind
from agents.intentional.executor.trace import Calendar
from agents.shared.sessions import sessions_of
from asp.language import Literal, atom, complement
from asp.reasoning.knowledge import knowledge
from asp.solving import State
from testbed.protocol import Event, Percept


class CoarseDiagram:
    """The transitions of what is left of a task, and the fluents that they are about."""

    def __init__(self, abstract: AbstractTask) -> None:
        self._abstract = abstract
        self._knowledge = knowledge(abstract.task.domain, abstract.task.source)
        description = self._knowledge.description
        self.fluents = tuple(abstract.back(description.fluents))
        self.inertial = tuple(abstract.back(description.inertial))
        self.robot = abstract.constant(description.robots[0])

    def after(self, state: State, action: str | None, events: Iterable[str]) -> State | None:
        """The next state, where the action and the events occur together; None: they cannot."""
        abstract = self._abstract
        attempt = None if action is None else abstract.seen([action])[0]
        transitions = sessions_of(self._knowledge).transitions
        found = transitions.after(
            frozenset(abstract.seen(state)), attempt, tuple(abstract.seen(events))
        )
        if found is None or (action is not None and not found[1]):
            return None
        return frozenset(abstract.back(found[0]))

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
        return list(filter(self._abstract.is_about, events))


@dataclass(frozen=True)
class Outcome:
    """An abstract action that is over, whether it had its effects, and what these were to be.

    One without its effects need not have been impossible: its execution may have failed.
    """

    action: str
    happened: bool
    effects: tuple[str, ...]


class Reporter:
    """Lifts what was observed at the fine resolution to the coarse one."""

    def __init__(self, mind: Mind, coarse: CoarseDiagram, calendar: Calendar) -> None:
        self._mind = mind
        self._coarse = coarse
        self._calendar = calendar
        self._later: list[str] = []

    def percept(
        self, percept: Percept, believed: State, outcome: Outcome | None
    ) -> tuple[Percept, State]:
        """The percept of the next coarse step, and the state that was to be expected there.

        It says whether the action happened, and of what is known whatever is contrary to
        expectation. What is as expected says nothing new, and it was observed a while ago: added to
        the history as seen at this step it would deny that anything happened since.
        """
        action = outcome.action if outcome is not None and outcome.happened else None
        events = self._events(believed, action, outcome)
        at_last = [event.action for event in events if event.step >= self._latest(outcome)]
        coarse = self._coarse
        expected = coarse.after(believed, action, at_last) or believed
        soon = coarse.news(expected, None, self._later)
        told = [*map(Literal.parse, self._contrary(coarse.after(expected, None, soon) or expected))]
        return Percept(
            trial=percept.trial,
            step=self._calendar.step + 1,
            visible=told,
            doubtful=[literal for literal in told if self._mind.is_doubtful(literal)],
            attempted=None if outcome is None else Literal.parse(outcome.action),
            happened=None if outcome is None else outcome.happened,
            failing=outcome is not None and not outcome.happened,
            events=events,
            goal_holds=percept.goal_holds,
        ), expected

    def inferred(self, outcome: Outcome) -> list[str]:
        """The effects of an action that follow from what is known."""
        mind = self._mind
        effects = [effect for effect in outcome.effects if mind.is_magnified(effect)]
        return sorted(mind.belief.coarse(list(map(atom, effects))).intersection(effects))

    def _contrary(self, expected: State) -> Iterator[str]:
        mind = self._mind
        magnified = [fluent for fluent in self._coarse.fluents if mind.is_magnified(fluent)]
        with mind.tally.timing("infer"):
            follows = mind.belief.coarse(magnified)
        for fluent in self._coarse.fluents:
            surprise = complement(fluent) if fluent in expected else fluent
            if (
                surprise in follows
                if mind.is_magnified(fluent)
                else self._differs(fluent, expected)
            ):
                yield surprise

    def _differs(self, fluent: str, expected: State) -> bool:
        seen = fluent in self._mind.noticed
        return seen and (fluent in self._mind.unmagnified) != (fluent in expected)

    def _latest(self, outcome: Outcome | None) -> int:
        """The coarse step to which news of the present one is put down.

        Where an action failed, what made it impossible happened before it was attempted.
        """
        now = self._calendar.step
        return max(1, now - 1) if outcome is not None and not outcome.happened else now

    def _events(self, believed: State, action: str | None, outcome: Outcome | None) -> list[Event]:
        """The news as events of coarse steps."""
        mind, latest = self._mind, self._latest(outcome)
        heard = [
            (min(latest, self._calendar.coarse(step)), coarse)
            for step, event in mind.news
            for coarse in mind.refinement.coarse_of(event)
        ]
        mind.news.clear()
        recent = [*self._later, *(event for step, event in heard if step == latest)]
        possible = self._coarse.news(believed, action, recent)
        self._later = self._after(believed, action, recent, possible)
        earlier = [
            Event(step=step, action=Literal.parse(event)) for step, event in heard if step < latest
        ]
        return [*earlier, *(Event(step=latest, action=Literal.parse(event)) for event in possible)]

    def _after(
        self, believed: State, action: str | None, recent: list[str], possible: list[str]
    ) -> list[str]:
        """The events that can only have happened when the action was done: news of the next step.

        So it is with an object that is taken away as soon as it is put down.
        """
        coarse = self._coarse
        done = None if action is None else coarse.after(believed, action, possible)
        if done is None:
            return []
        return [
            event
            for event in coarse.about(recent)
            if event not in possible
            and coarse.after(believed, action, [event]) is None
            and coarse.after(done, None, [event]) is not None
        ]
