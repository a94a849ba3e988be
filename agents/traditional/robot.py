"""The robot TP: plans, executes, looks only at the outcome of the action in hand."""

from __future__ import annotations

from collections.abc import Callable
from typing import Protocol

from agents.shared.diagnosis import Explained
from agents.shared.history import Diagnosis, History
from agents.shared.knowledge import Knowledge, knowledge
from agents.shared.relevance import outcome_literals
from agents.traditional.kept import KeptPlanner
from agents.traditional.planner import Plan
from asp.kept.clock import reasoning_clock
from asp.solving import OUT_OF_TIME, TimeLimitError, time_limit
from testbed.link.messages import Decision, Explanation, Percept, Task, Trace


class Reasoner(Protocol):
    """Diagnosis and planning for one goal."""

    def diagnose(self, history: History, adopted: Diagnosis) -> Explained: ...

    def plan(self, history: History, diagnosis: Diagnosis, /) -> Plan: ...


class TraditionalRobot:
    """Plans, executes, replans where the outcome of its action contradicts its belief.

    It has no intentions: its history holds physical actions only. When its plan is over it
    finishes, and does not heed what it is told of the goal afterwards.

    `reasoner` makes, of a domain, a goal and the greatest length of a plan, what the robot reasons
    with: kept controls (`KeptPlanner`), or programs solved from scratch (`Planner`).
    """

    def __init__(
        self, reasoner: Callable[[Knowledge, tuple[str, ...], int], Reasoner] = KeptPlanner
    ) -> None:
        self._make_reasoner = reasoner

    def begin(self, task: Task) -> None:
        """Takes the task on; the first plan is made with the first percept."""
        self._domain = domain = knowledge(task.domain, task.source)
        self._description = domain.description
        self._reasoner = self._make_reasoner(domain, tuple(task.goal), task.plan_limit)
        self._history = History()
        self._history.observe(task.initial, 0)
        self._diagnosis = Diagnosis()
        self._decision_s = task.decision_s
        self._plan: Plan | None = None
        self._plans = 0

    def act(self, percept: Percept) -> Decision:
        """The next action of the plan; where the time for a decision runs out, it waits a step.

        Raises InconsistentHistoryError.
        """
        self._observe(percept)
        began = reasoning_clock()
        try:
            with time_limit(self._decision_s):
                return self._decide(percept)
        except TimeLimitError:
            trace = Trace(
                reason=OUT_OF_TIME,
                plans=self._plans,
                planning_time_s=reasoning_clock() - began,
            )
            return Decision(
                trial=percept.trial,
                step=percept.step,
                action="wait",
                believes_goal=False,
                trace=trace,
            )

    def _decide(self, percept: Percept) -> Decision:
        began = reasoning_clock()
        explained = self._reasoner.diagnose(self._history, self._diagnosis)
        diagnosed = reasoning_clock()
        failed = percept.happened is False
        self._diagnosis = explained.diagnosis
        planned = self._plan is None or failed or not explained.kept
        plan = None if planned else self._plan
        if plan is None:
            self._plan = None  # a plan is still to be made if the time runs out in between
            plan = self._reasoner.plan(self._history, explained.diagnosis)
        self._plans += planned and bool(plan.actions)
        ended = reasoning_clock()
        action = plan.actions[0] if plan.actions else "finish"
        if plan.actions:
            self._history.attempt(action, percept.step)
        self._plan = Plan(plan.actions[1:], plan.believed, plan.reachable)
        trace = Trace(
            intention=action,
            plan=list(plan.actions),
            belief=list(plan.believed) if planned else [],
            explanation=None if explained.kept else self._explanation(percept.step),
            plans=self._plans,
            planning_time_s=ended - diagnosed,
            diagnosis_time_s=diagnosed - began,
        )
        believes_goal = not plan.actions and plan.reachable
        return Decision(
            trial=percept.trial,
            step=percept.step,
            action=action,
            believes_goal=believes_goal,
            trace=trace,
        )

    def _observe(self, percept: Percept) -> None:
        history = self._history
        if percept.attempted is not None:
            history.happened(percept.attempted, percept.happened is not False, history.step)
        for event in percept.events:
            history.happened(event.action, True, event.step)
        history.step = percept.step
        outcome = outcome_literals(self._description, percept.attempted, percept.visible)
        history.observe(outcome, percept.step)

    def _explanation(self, step: int) -> Explanation:
        exceptions = self._domain.against(self._diagnosis.exceptions)
        return Explanation(
            step=step,
            unobserved=list(self._diagnosis.unobserved),
            exceptions=exceptions,
            distrusted=list(self._diagnosis.distrusted),
        )
