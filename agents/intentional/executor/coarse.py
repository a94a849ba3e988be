"""What the coarse robot is told of the fine resolution."""

from agents.intentional.abstraction import AbstractTask
from agents.intentional.executor.belief import FineTracker
from agents.intentional.executor.execution import Execution
from agents.intentional.executor.trace import CoarseSteps
from asp.language import Action, Literal
from asp.solving import State
from testbed.protocol import Event, Percept


class Reporter:
    """Lifts what was observed at the fine resolution to the coarse one."""

    def __init__(self, fine: FineTracker, coarse: AbstractTask, steps: CoarseSteps) -> None:
        self._fine = fine
        self._coarse = coarse
        self._steps = steps
        self._later: list[Literal] = []

    def percept(
        self, percept: Percept, believed: State, over: Execution | None
    ) -> tuple[Percept, State]:
        """The percept of the next coarse step, and the state that was to be expected there.

        It says whether the action happened, and of what is known whatever is contrary to
        expectation. What is as expected says nothing new, and it was observed a while ago: added to
        the history as seen at this step it would deny that anything happened since.
        """
        action = over.action if over is not None and over.happened else None
        events = self._events(believed, action, over)
        at_last = [event.action for event in events if event.step >= self._latest(over)]
        coarse = self._coarse
        expected = coarse.after(believed, action, at_last) or believed
        soon = coarse.news(expected, None, self._later)
        told = self._contrary(coarse.after(expected, None, soon) or expected)
        return Percept(
            trial=percept.trial,
            step=self._steps.present + 1,
            visible=told,
            doubtful=[literal for literal in told if self._fine.is_doubtful(literal)],
            attempted=None if over is None else over.action,
            happened=None if over is None else over.happened,
            failing=over is not None and not over.happened,
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

    def _latest(self, over: Execution | None) -> int:
        """The coarse step to which news of the present one is put down.

        Where an action failed, what made it impossible happened before it was attempted.
        """
        now = self._steps.present
        return max(1, now - 1) if over is not None and not over.happened else now

    def _events(
        self, believed: State, action: Action | None, over: Execution | None
    ) -> list[Event]:
        """The news as events of coarse steps."""
        latest = self._latest(over)
        heard = [
            (min(latest, self._steps.coarse(step)), coarse)
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
