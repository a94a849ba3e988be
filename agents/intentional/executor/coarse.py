"""Percepts of the coarse robot from the fine resolution, each at its coarse step."""

from __future__ import annotations

from bisect import bisect_right
from copy import copy

from agents.intentional.abstraction import AbstractTask
from agents.intentional.executor.belief import FineTracker
from agents.intentional.executor.execution import Execution
from asp.language import Action, Literal
from asp.solving import State
from testbed.protocol import Event, Percept


class Reporter:
    """Lifts what was observed at the fine resolution to the coarse one.

    It knows when each coarse step began, in steps of the environment. Step 0 is that of both, at
    which the goal is selected.
    """

    def __init__(self, fine: FineTracker, coarse: AbstractTask) -> None:
        self._fine = fine
        self._coarse = coarse
        self._began = [0]
        self._later: list[Literal] = []

    def copy(self, fine: FineTracker) -> Reporter:
        """The same, of a trial that may go on otherwise, with a copy of the tracker."""
        other = copy(self)
        other._fine, other._began, other._later = fine, [*self._began], [*self._later]
        return other

    def begin(self, step: int) -> None:
        """The next coarse step begins at this step of the environment."""
        self._began.append(step)

    def own(self, step: int) -> int:
        """The step of the environment at which a coarse step began, or may begin at the soonest."""
        ahead = max(0, step + 1 - len(self._began))
        return self._began[step - ahead] + ahead

    def percept(
        self, percept: Percept, believed: State, over: Execution | None
    ) -> tuple[Percept, State]:
        """The percept of the next coarse step, and the state that was to be expected there.

        It says whether the action happened, and of what is known whatever is contrary to
        expectation. What is as expected says nothing new, and it was observed a while ago: added to
        the history as seen at this step it would deny that anything happened since.
        """
        now, failing = len(self._began) - 1, over is not None and not over.happened
        action = None if over is None or failing else over.action
        # What made an action impossible that failed happened before it was attempted.
        latest = max(1, now - 1) if failing else now
        events = self._events(believed, action, latest)
        at_last = [event.action for event in events if event.step == latest]
        coarse = self._coarse
        expected = coarse.after(believed, action, at_last) or believed
        soon = coarse.news(expected, None, self._later)
        told = self._contrary(coarse.after(expected, None, soon) or expected)
        return Percept(
            trial=percept.trial,
            step=now + 1,
            visible=told,
            doubtful=[literal for literal in told if self._fine.is_doubtful(literal)],
            attempted=None if over is None else over.action,
            happened=None if over is None else over.happened,
            failing=failing,
            events=events,
            goal_holds=percept.goal_holds,
        ), expected

    def _contrary(self, expected: State) -> list[Literal]:
        """What is known to the contrary, and what was seen of fluents without counterparts."""
        fine = self._fine
        contrary = [f.complement if f in expected else f for f in self._coarse.fluents]
        with fine.trace.timing("infer"):
            holding = fine.holding(contrary)
        return [each for each in holding if fine.is_magnified(each) or each.atom in fine.noticed]

    def _events(self, believed: State, action: Action | None, latest: int) -> list[Event]:
        """The news as events of coarse steps, of which the latest one has that of the present."""
        heard = [
            (min(latest, bisect_right(self._began, step) - 1), coarse)
            for step, event in self._fine.news
            for coarse in self._fine.refinement.coarse_of(event)
        ]
        self._fine.news.clear()
        recent = [*self._later, *(event for step, event in heard if step == latest)]
        possible = self._coarse.news(believed, action, recent)
        self._later = self._after(believed, action, recent, possible)
        earlier = [pair for pair in heard if pair[0] < latest]
        told = [*earlier, *((latest, event) for event in possible)]
        return [Event(step=step, action=event) for step, event in told]

    def _after(
        self, believed: State, action: Action | None, recent: list[Literal], possible: list[Action]
    ) -> list[Literal]:
        """The events that can only have happened when the action was done: news of the next step.

        So it is with an object that is taken away as soon as it is put down.
        """
        coarse = self._coarse
        done = None if action is None else coarse.after(believed, action, possible)
        if done is None:
            return []
        return [
            event
            for event in filter(coarse.is_about, recent)
            if event not in possible
            and coarse.after(believed, action, [event]) is None
            and coarse.after(done, None, [event]) is not None
        ]
