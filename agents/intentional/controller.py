"""The control loop AIA: interpret, intend, attempt, observe (spec 2)."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import Protocol

from agents.intentional.intention import Intention
from agents.intentional.kept import KeptLogician
from agents.shared.diagnosis import Explained
from agents.shared.history import GOAL, Activity, Diagnosis, History
from agents.shared.knowledge import Knowledge, knowledge
from agents.shared.relevance import goal_fluents, relevant_literals
from asp.kept.clock import reasoning_clock
from testbed.link.messages import Decision, Explanation, Percept, Task, Trace

_MENTAL = ("start(", "stop(")


class Reasoner(Protocol):
    """The two phases of reasoning about one goal."""

    def diagnose(self, history: History, adopted: Diagnosis) -> Explained: ...

    def intend(self, history: History, explained: Explained) -> Intention: ...


class IntentionalRobot:
    """A robot that reasons with the adapted theory of intentions (ATI).

    `reasoner` makes, of a domain, a goal and the greatest length of a plan, what the robot reasons
    with: kept controls (`KeptLogician`), or the theory solved from scratch (`Logician`).
    """

    def __init__(
        self, reasoner: Callable[[Knowledge, tuple[str, ...], int], Reasoner] = KeptLogician
    ) -> None:
        self._reasoner = reasoner

    def begin(self, task: Task) -> None:
        """Selects the task's goal at step 0, where it knows `task.initial`."""
        self._task = task
        self._domain = domain = knowledge(task.domain, task.source)
        self._description = domain.description
        self._goal_fluents = goal_fluents(domain.description, task.goal)
        self._logician = self._reasoner(domain, tuple(task.goal), task.plan_limit)
        self._diagnosis = Diagnosis()
        self._history = History()
        self._history.observe(task.initial, 0)
        self._history.happened(f"select({GOAL})", True, 0)
        self._attempted: str | None = None

    def act(self, percept: Percept) -> Decision:
        """One round of the loop. Raises InconsistentHistoryError."""
        self._observe(percept)
        began = reasoning_clock()
        explained = self._logician.diagnose(self._history, self._diagnosis)
        diagnosed = reasoning_clock()
        intention = self._logician.intend(self._history, explained)
        planned = reasoning_clock()
        if intention.under is not None:
            kept = intention.under == self._diagnosis
            explained = replace(explained, diagnosis=intention.under, kept=kept)
        self._diagnosis = explained.diagnosis
        self._attempt(intention)
        trace = self._trace(intention, explained, diagnosed - began, planned - diagnosed)
        return Decision(
            trial=percept.trial,
            step=percept.step,
            action="wait" if intention.action.startswith(_MENTAL) else intention.action,
            believes_goal=GOAL in intention.believed,
            trace=trace,
        )

    def _observe(self, percept: Percept) -> None:
        """Steps 4 and 1 of the loop: the result of the last attempt, then what is relevant."""
        history = self._history
        if self._attempted is not None:
            # A mental action and finishing cannot fail; the world only answers physical ones.
            success = percept.happened if self._attempted == percept.attempted else True
            history.happened(self._attempted, success is not False, history.step)
        for event in percept.events:
            history.happened(event.action, True, event.step)
        if percept.goal_holds is not None:
            history.observe([GOAL if percept.goal_holds else f"-{GOAL}"], history.step)
        history.step = percept.step
        actions = (percept.attempted,)
        relevant = relevant_literals(
            self._description, self._goal_fluents, actions, percept.visible
        )
        history.observe(relevant, percept.step)

    def _attempt(self, intention: Intention) -> None:
        """Step 3 of the loop: the attempt is recorded, and a new activity with it."""
        history = self._history
        history.attempt(intention.action, history.step)
        self._attempted = intention.action
        if intention.action == f"start({len(history.activities) + 1})":
            history.activities.append(Activity(len(history.activities) + 1, intention.plan))

    def _trace(
        self, intention: Intention, explained: Explained, diagnosis_s: float, planning_s: float
    ) -> Trace:
        mental = intention.action if intention.action.startswith(_MENTAL) else None
        step = self._history.step
        return Trace(
            mental=mental,
            intention=intention.action,
            activity=max(explained.indices, default=None),
            plan=list(intention.plan),
            belief=sorted(intention.believed - {GOAL}),
            explanation=None if explained.kept else self._explanation(explained.diagnosis),
            futile_at=step if intention.action.startswith("stop(") else None,
            plans=len(self._history.activities),
            planning_time_s=planning_s,
            diagnosis_time_s=diagnosis_s,
        )

    def _explanation(self, diagnosis: Diagnosis) -> Explanation:
        return Explanation(
            step=self._history.step,
            unobserved=list(diagnosis.unobserved),
            exceptions=self._domain.against(diagnosis.exceptions),
        )
