"""The control loop AIA: interpret, intend, attempt, observe (D 2)."""

from typing import ClassVar

from msgspec import structs

from agents.intentional.reasoners import Activity, History, IncrementalReasoner, start_activity
from agents.intentional.reasons import IntentionalReasons
from agents.shared.relevance import goal_fluents, relevant_literals
from agents.shared.robot import MakeReasoner, ReasoningRobot
from agents.shared.thought import Intention, Reasoner, Thought
from asp.language import Action, Literal
from asp.reasoning.diagnosis import GOAL, SELECT, Diagnosis
from testbed.protocol import FINISH, WAIT, Capabilities, Percept, Task, Trace, is_mental

_MENTAL = ("start(", "stop(")


class IntentionalRobot(ReasoningRobot[History]):
    """A robot that reasons with the adapted theory of intentions (ATI).

    `reasoner` is the `IncrementalReasoner`, the `ReferenceReasoner` that solves the theory from
    scratch, or another one.
    """

    # At step 1 it starts an activity, or finishes.
    capabilities: ClassVar = Capabilities(knowledge=("complete", "seen"), first_action_step=2)
    _reasons_type = IntentionalReasons
    _reasons: IntentionalReasons

    def __init__(self, reasoner: MakeReasoner[History] = IncrementalReasoner) -> None:
        super().__init__(reasoner)

    def _begin(self, task: Task) -> None:
        """Selects the task's goal at step 0."""
        self._goal_fluents = goal_fluents(self._domain.description, task.goal)
        self._history = History()
        self._history.observe(task.initial, 0)
        self._history.happened(SELECT, True, 0)
        self._attempted: Action | None = None

    def _intend(self, reasoner: Reasoner[History], thought: Thought) -> Intention:
        intention = super()._intend(reasoner, thought)
        if intention.under is not None:
            thought.diagnosis, self._explanation = intention.under, intention.under.explanation
        return intention

    def _hear(self, percept: Percept) -> None:
        """Step 4 of the loop: the result of the last attempt, and of having finished."""
        history = self._history
        if self._attempted is not None:
            # A mental action and finishing cannot fail; the world only answers physical ones.
            success = percept.happened if self._attempted == percept.attempted else True
            history.happened(self._attempted, success is not False, history.step)
            if success is False and percept.failing:
                history.failed(self._attempted, history.step)
        if percept.goal_holds is not None:
            history.observe([GOAL if percept.goal_holds else GOAL.complement], history.step)

    def _relevant(self, percept: Percept) -> tuple[Literal, ...]:
        """Step 1 of the loop: what bears on the goal, or on the last attempt (P 3.2)."""
        description = self._domain.description
        return relevant_literals(
            description, self._goal_fluents, percept.attempted, percept.visible
        )

    def _attempt(self, intention: Intention | None) -> None:
        """Step 3 of the loop: the attempt is recorded, and a new activity with it."""
        self._attempted = None if intention is None else intention.action
        if intention is None:
            return
        history = self._history
        self._believed = (history.step, intention.believed - {GOAL})
        history.attempt(intention.action, history.step)
        name = len(history.activities) + 1
        if intention.action == start_activity(name):
            history.activities.append(Activity(name, intention.plan))

    def _physical(self, intention: Intention) -> Action:
        return WAIT if is_mental(intention.action) else intention.action

    def _trace(self, thought: Thought) -> Trace:
        intention, diagnosis = thought.intention, thought.diagnosis
        trace = Trace(
            belief=sorted(self._believed[1]),
            reason=thought.limit,
            activity=None if diagnosis is None else max(diagnosis.indices, default=None),
            plans=len(self._history.activities),
        )
        if diagnosis is not None:
            trace = self._with_alternatives(self._with_explanation(trace), diagnosis)
        if diagnosis is None or intention is None:
            return trace
        trace = structs.replace(
            trace,
            mental=intention.action if is_mental(intention.action) else None,
            intention=Literal.parse(intention.action),
            plan=list(map(Literal.parse, self._ahead(intention, diagnosis))),
            belief=sorted(map(Literal.parse, intention.believed - {GOAL})),
            plans=trace.plans + (intention.action == start_activity(trace.plans + 1)),
        )
        return self._reasons.explained(trace, self._history, intention, diagnosis)

    def _with_alternatives(self, trace: Trace, diagnosis: Diagnosis) -> Trace:
        """The trace with the other explanations that are as small, if there is a new one."""
        if trace.explanation is None:
            return trace
        others, more = self._reasons.alternatives(self._history, diagnosis)
        return structs.replace(trace, alternatives=others, more_alternatives=more)

    def _ahead(self, intention: Intention, diagnosis: Diagnosis) -> tuple[Action, ...]:
        """The plan that is started, or what is left of the one that is carried out."""
        if intention.action == FINISH or is_mental(intention.action):
            return intention.plan
        name, index = next(iter(diagnosis.indices.items()))
        return self._history.activities[name - 1].plan[index:]
