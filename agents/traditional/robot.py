"""The robot TP: plans, executes, looks only at the outcome of the action in hand."""

from __future__ import annotations

import time
from collections.abc import Iterator
from dataclasses import dataclass

from clingo import Symbol

from agents.shared.diagnosis import Explained, diagnose
from agents.shared.history import Diagnosis, History
from agents.shared.knowledge import goal_facts, knowledge
from agents.shared.relevance import outcome_literals
from asp.solving import first_model, ground, select, theory
from testbed.link.messages import Decision, Explanation, Percept, Task, Trace


@dataclass(frozen=True)
class Plan:
    """The actions that are left and what is believed now; `reachable` if they reach the goal."""

    actions: tuple[str, ...]
    believed: tuple[str, ...]
    reachable: bool


class TraditionalRobot:
    """Plans, executes, replans where the outcome of its action contradicts its belief.

    It has no intentions: its history holds physical actions only. When its plan is over it
    finishes, and does not heed what it is told of the goal afterwards.
    """

    def begin(self, task: Task) -> None:
        """Takes the task on; the first plan is made with the first percept."""
        domain = knowledge(task.domain, task.source)
        self._description = domain.description
        self._base = (domain.program, theory("history"))
        self._given = (*domain.ranks, *goal_facts(task.goal))
        self._plan_limit = task.plan_limit
        self._history = History()
        self._history.observe(task.initial, 0)
        self._diagnosis = Diagnosis()
        self._plan: Plan | None = None
        self._plans = 0

    def act(self, percept: Percept) -> Decision:
        """The next action of the plan. Raises InconsistentHistoryError."""
        self._observe(percept)
        began = time.perf_counter()
        explained = self._explain()
        diagnosed = time.perf_counter()
        planned = self._plan is None or not explained.kept
        plan = self._make_plan(explained.diagnosis) if planned else self._plan
        assert plan is not None
        self._diagnosis = explained.diagnosis
        self._plans += planned and bool(plan.actions)
        ended = time.perf_counter()
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

    def _explain(self) -> Explained:
        constants = {"n": self._history.step}
        return diagnose(self._base, constants, self._facts(), self._history, self._diagnosis)

    def _make_plan(self, diagnosis: Diagnosis) -> Plan:
        """A shortest plan, by iterative deepening; an empty one where there is none."""
        texts = [*self._base, theory("traditional")]
        facts = [*self._facts(), *diagnosis.facts("explained")]
        for length in range(self._plan_limit + 1):
            model = first_model(ground(texts, {"n": self._history.step + length}, facts))
            if model is not None:
                return _read(model)
        return Plan((), (), reachable=False)

    def _facts(self) -> Iterator[Symbol]:
        yield from self._given
        yield from self._history.facts()

    def _explanation(self, step: int) -> Explanation:
        return Explanation(step=step, unobserved=list(self._diagnosis.unobserved), exceptions=[])


def _read(model: tuple[Symbol, ...]) -> Plan:
    steps = sorted((index.number, str(action)) for index, action in select(model, "plan", 2))
    believed = tuple(str(fluent) for (fluent,) in select(model, "believed", 1))
    return Plan(tuple(action for _, action in steps), believed, reachable=True)
