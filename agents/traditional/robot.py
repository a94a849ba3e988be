"""The robot TP: plans, executes, looks only at the outcome of the action in hand."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Protocol

from msgspec import structs

from agents.shared.contradictions import Contradicting
from agents.shared.diagnosis import Explained
from agents.shared.history import Diagnosis, History
from agents.shared.knowledge import Knowledge, knowledge
from agents.shared.limits import limits_of
from agents.shared.no_plan import GivingUp
from agents.shared.relevance import outcome_literals
from agents.shared.timing import Phases
from agents.traditional.incremental import KeptPlanner
from agents.traditional.reference import Plan
from asp.language import is_positive
from asp.solving import LimitError, State, deciding, preparation, reasoning_clock
from testbed.protocol import Decision, Explanation, Percept, Task, Trace


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
        began = reasoning_clock()
        with deciding(), preparation():
            self._begin(task)
        self._prepared = reasoning_clock().since(began).preparation_cpu

    def _begin(self, task: Task) -> None:
        self._domain = domain = knowledge(task.domain, task.source)
        self._description = domain.description
        self._goal = tuple(task.goal)
        self._reasoner: Reasoner | None = None
        self._history = History()
        self._history.observe(task.initial, 0)
        self._diagnosis = Diagnosis()
        self._limits = limits_of(task)
        self._plan: Plan | None = None
        self._plans = 0
        self._told = self._diagnosis
        self._believed: tuple[int, State] = (0, frozenset(filter(is_positive, task.initial)))
        self._plan_limit = task.plan_limit

    def act(self, percept: Percept) -> Decision:
        """The next action of the plan; where it reaches a limit of decisions, it waits a step.

        Raises InconsistentHistoryError.
        """
        with deciding() as decision:
            self._observe(percept)
            thought = _Thought()
            try:
                with deciding(self._limits):
                    self._think(thought)
            except LimitError as limit:
                thought.phases.end()
                thought.limit = str(limit)
            trace = thought.phases.timed(self._trace(thought, percept.step), self._prepared)
        plan = thought.plan
        trace = structs.replace(trace, deadline=decision.late)
        self._prepared = 0.0
        if plan is not None:
            self._attempt(plan)
        return Decision(
            trial=percept.trial,
            step=percept.step,
            action="wait" if plan is None else _next(plan),
            believes_goal=plan is not None and not plan.actions and plan.reachable,
            trace=trace,
        )

    def _prepare(self) -> Reasoner:
        """What the domain is reasoned with, made in a decision so that its limits hold for it."""
        with preparation():
            self._contradicting = Contradicting(self._domain, self._goal)
            self._giving_up = GivingUp(self._domain, self._goal, self._plan_limit, self._limits)
            self._reasoner = self._make_reasoner(self._domain, self._goal, self._plan_limit)
        return self._reasoner

    def _think(self, thought: _Thought) -> None:
        """Diagnosis, and a plan if there is none. What was found remains at a limit."""
        reasoner = self._reasoner or self._prepare()
        explained = reasoner.diagnose(self._history, self._diagnosis)
        thought.phases.diagnosis_is_over()
        self._diagnosis = explained.diagnosis
        if not explained.kept:
            self._plan = None
        thought.made = self._plan is None
        plan = self._plan or reasoner.plan(self._history, self._diagnosis)
        thought.phases.end()
        thought.plan = plan

    def _attempt(self, plan: Plan) -> None:
        """Step by step through the plan: what is attempted is recorded, the rest remains."""
        if plan.actions:
            self._history.attempt(plan.actions[0], self._history.step)
        self._plan = Plan(plan.actions[1:], plan.believed, plan.reachable)

    def _observe(self, percept: Percept) -> None:
        history = self._history
        if percept.attempted is not None:
            history.happened(percept.attempted, percept.happened is not False, history.step)
        if percept.happened is False:
            self._plan = None  # whenever there will be time for another one
        for event in percept.events:
            history.happened(event.action, True, event.step)
        history.step = percept.step
        outcome = outcome_literals(self._description, percept.attempted, percept.visible)
        history.observe(outcome, percept.step)

    def _trace(self, thought: _Thought, step: int) -> Trace:
        """The mind behind the decision, before anything of it is recorded."""
        trace = self._with_explanation(Trace(reason=thought.limit, plans=self._plans), step)
        plan = thought.plan
        if plan is None:
            return trace
        if thought.made:
            self._believed = (step, frozenset(plan.believed))
        self._plans += thought.made and bool(plan.actions)
        no_plan, given_up = (None, "") if plan.reachable else self._giving_up.why(plan.believed)
        return structs.replace(
            trace,
            intention=_next(plan),
            plan=list(plan.actions),
            belief=list(plan.believed) if thought.made else [],
            reason=given_up or _why(thought.made, plan),
            no_plan=no_plan,
            plans=self._plans,
        )

    def _with_explanation(self, trace: Trace, step: int) -> Trace:
        """The trace with the explanation, and what made it needed, if it has not been told yet."""
        diagnosis, before = self._diagnosis, self._told
        if diagnosis == before:
            return trace
        self._told = diagnosis
        since, believed = self._believed
        return structs.replace(
            trace,
            explanation=Explanation(
                step=step,
                unobserved=list(diagnosis.unobserved),
                exceptions=self._domain.against(diagnosis.exceptions),
                distrusted=list(diagnosis.distrusted),
                minimal="proved" if diagnosis.proved else "unproved",
            ),
            contradictions=self._contradicting.contradictions(
                self._history, before, believed, since
            ),
        )


@dataclass
class _Thought:
    """What is found in one decision, as far as it comes, and what it takes."""

    phases: Phases = field(default_factory=Phases)
    plan: Plan | None = None
    made: bool = False
    limit: str = ""


def _why(made: bool, plan: Plan) -> str:
    """Why a plan that reaches the goal is carried out."""
    if not plan.actions:
        return "the goal holds" if made else "the plan is over"
    left = f"{len(plan.actions)} action{'' if len(plan.actions) == 1 else 's'}"
    return f"a new plan: {left} to the goal, none fewer" if made else f"{left} of the plan left"


def _next(plan: Plan) -> str:
    return plan.actions[0] if plan.actions else "finish"
