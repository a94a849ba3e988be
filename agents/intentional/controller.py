"""The control loop AIA: interpret, intend, attempt, observe (D 2)."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field, replace
from typing import Protocol

from msgspec import structs

from agents.intentional.incremental import KeptLogician
from agents.intentional.intention import Intention
from agents.intentional.reasons import Reasons
from agents.shared.diagnosis import Explained, InconsistentHistoryError
from agents.shared.history import GOAL, Activity, Diagnosis, History
from agents.shared.knowledge import Knowledge, knowledge
from agents.shared.limits import limits_of
from agents.shared.misreadings import distrust
from agents.shared.relevance import goal_fluents, relevant_literals
from agents.shared.timing import Phases
from asp.language import is_positive
from asp.solving import LimitError, deciding, preparation, reasoning_clock
from testbed.protocol import Decision, Event, Percept, Task, Trace

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
        began = reasoning_clock()
        with deciding(), preparation():
            self._begin(task)
        self._prepared = reasoning_clock().since(began).preparation_cpu

    def _begin(self, task: Task) -> None:
        self._task = task
        self._domain = domain = knowledge(task.domain, task.source)
        self._description = domain.description
        self._goal_fluents = goal_fluents(domain.description, task.goal)
        self._limits = limits_of(task)
        self._logician: Reasoner | None = None
        self._diagnosis = Diagnosis()
        self._history = History()
        self._history.observe(task.initial, 0)
        self._history.happened(f"select({GOAL})", True, 0)
        self._misread: tuple[Event, ...] = ()
        self._attempted: str | None = None
        start = frozenset(filter(is_positive, task.initial))
        self._believed: tuple[int, frozenset[str]] = (0, start)

    def act(self, percept: Percept) -> Decision:
        """One round of the loop; where it reaches a limit of decisions, the robot waits a step.

        Raises InconsistentHistoryError.
        """
        with deciding() as decision:
            self._observe(percept)
            thought = _Thought(self._diagnosis)
            try:
                with deciding(self._limits):
                    self._think(thought)
            except LimitError as limit:
                thought.phases.end()
                thought.limit = str(limit)
            trace = thought.phases.timed(self._trace(thought), self._prepared)
        trace = structs.replace(trace, deadline=decision.late)
        self._prepared = 0.0
        intention = thought.intention
        self._attempt(intention)
        if intention is not None:
            self._believed = (percept.step, intention.believed)
        waits = intention is None or intention.action.startswith(_MENTAL)
        return Decision(
            trial=percept.trial,
            step=percept.step,
            action="wait" if intention is None or waits else intention.action,
            believes_goal=intention is not None and GOAL in intention.believed,
            trace=trace,
        )

    def _prepare(self) -> Reasoner:
        """What the domain is reasoned with, made in a decision so that its limits hold for it."""
        goal, plan_limit = tuple(self._task.goal), self._task.plan_limit
        with preparation():
            self._reasons = Reasons(self._domain, goal, plan_limit, self._limits)
            self._logician = self._reasoner(self._domain, goal, plan_limit)
        return self._logician

    def _think(self, thought: _Thought) -> None:
        """Both phases. Raises LimitError, after which what was found so far is kept."""
        logician = self._logician or self._prepare()
        explained = self._explained(logician)
        thought.phases.diagnosis_is_over()
        thought.explained, self._diagnosis = explained, explained.diagnosis
        intention = logician.intend(self._history, explained)
        thought.phases.end()
        thought.intention = intention
        if intention.under is not None:
            self._diagnosis = intention.under.diagnosis
            kept = self._diagnosis == thought.before
            thought.explained = replace(intention.under, kept=kept)

    def _explained(self, logician: Reasoner) -> Explained:
        """Phase one; where no events explain the history, tests were wrong."""
        try:
            return logician.diagnose(self._history, self._diagnosis)
        except InconsistentHistoryError:
            if not distrust(self._domain, tuple(self._task.goal), self._history):
                raise
            return logician.diagnose(self._history, self._diagnosis)

    def _observe(self, percept: Percept) -> None:
        """Steps 4 and 1 of the loop: the result of the last attempt, then what is relevant."""
        history = self._history
        if self._attempted is not None:
            # A mental action and finishing cannot fail; the world only answers physical ones.
            success = percept.happened if self._attempted == percept.attempted else True
            history.happened(self._attempted, success is not False, history.step)
            if success is False and percept.failing:
                history.failed(self._attempted, history.step)
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
        history.doubt(percept.doubtful, percept.step)

    def _attempt(self, intention: Intention | None) -> None:
        """Step 3 of the loop: the attempt is recorded, and a new activity with it."""
        self._attempted = None if intention is None else intention.action
        if intention is None:
            return
        history = self._history
        history.attempt(intention.action, history.step)
        if intention.action == f"start({len(history.activities) + 1})":
            history.activities.append(Activity(len(history.activities) + 1, intention.plan))

    def _trace(self, thought: _Thought) -> Trace:
        """The mind behind the decision, before anything of it is recorded."""
        intention, explained = thought.intention, thought.explained
        trace = Trace(
            belief=sorted(self._believed[1] - {GOAL}),
            reason=thought.limit,
            activity=None if explained is None else max(explained.indices, default=None),
            plans=len(self._history.activities),
        )
        if explained is not None:
            trace = self._with_explanation(trace, explained, thought.before)
        if explained is None or intention is None:
            return trace
        why = self._reasons.why(self._history, intention, explained)
        name = f"start({len(self._history.activities) + 1})"
        return structs.replace(
            trace,
            mental=intention.action if intention.action.startswith(_MENTAL) else None,
            intention=intention.action,
            plan=list(self._ahead(intention, explained)),
            belief=sorted(intention.believed - {GOAL}),
            reason=why.text,
            futile_at=why.futile_at,
            no_plan=why.no_plan,
            plans=trace.plans + (intention.action == name),
        )

    def _ahead(self, intention: Intention, explained: Explained) -> tuple[str, ...]:
        """The plan that is started, or what is left of the one that is carried out."""
        if intention.action == "finish" or intention.action.startswith(_MENTAL):
            return intention.plan
        name, index = next(iter(explained.indices.items()))
        return self._history.activities[name - 1].plan[index:]

    def _with_explanation(self, trace: Trace, explained: Explained, before: Diagnosis) -> Trace:
        """The trace with what is newly adopted, if anything is."""
        diagnosis, misread = explained.diagnosis, self._history.misread
        if diagnosis == before and misread == self._misread:
            return trace
        self._misread = misread
        explanation = self._reasons.explanation(diagnosis, self._history.step)
        step, believed = self._believed
        alternatives, more = self._reasons.alternatives(self._history, explained)
        return structs.replace(
            trace,
            explanation=structs.replace(
                explanation, distrusted=[*explanation.distrusted, *misread]
            ),
            contradictions=self._reasons.contradictions(
                self._history, before, believed - {GOAL}, step
            ),
            alternatives=alternatives,
            more_alternatives=more,
        )


@dataclass
class _Thought:
    """What is found in one round of the loop, as far as it comes, and what it takes."""

    before: Diagnosis
    phases: Phases = field(default_factory=Phases)
    explained: Explained | None = None
    intention: Intention | None = None
    limit: str = ""
