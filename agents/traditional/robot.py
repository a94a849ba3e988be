"""The robot TP: plans, executes, looks only at the outcome of the action in hand."""

from typing import ClassVar

from msgspec import structs

from agents.shared import Intention, MakeReasoner, Reasoner, ReasoningRobot, Thought
from agents.traditional.reasoners import IncrementalReasoner, ReferenceReasoner, intention_of
from asp.reasoning.diagnosis import GOAL, History
from testbed.protocol import Capabilities, Percept, Task, Trace


class TraditionalRobot(ReasoningRobot[History]):
    """Plans, executes, replans where the outcome of its action contradicts its belief.

    It has no intentions: its history holds physical actions only. When its plan is over it
    finishes, and does not heed what it is told of the goal afterwards.
    """

    capabilities: ClassVar = Capabilities(
        knowledge=("complete", "seen"), plans=("optimistic", "conformant"), snapshots=True
    )
    _make_reasoner: MakeReasoner[History] = IncrementalReasoner

    def _begin(self, task: Task) -> None:
        """The first plan is made with the first percept."""
        self._history = History()
        self._history.observe(task.initial, 0)
        self._rest: Intention | None = None
        self._plans = 0

    def _intend(self, reasoner: Reasoner[History], thought: Thought) -> Intention:
        """What is left of the plan, or a new one. What was found remains at a limit."""
        is_explained = self._explanation != thought.before.left(self._history)
        if is_explained or thought.outcome is not None:
            self._rest = None
        thought.is_new = self._rest is None
        return self._rest or super()._intend(reasoner, thought)

    def _attempt(self, intention: Intention) -> None:
        """Step by step through the plan: what is attempted is recorded, the rest remains."""
        if self._rest is None:
            believed = intention.believed - {GOAL}
            self._believed = (self._history.step, believed)
            self._expect(believed, intention.plan)
        if intention.plan:
            self._history.attempt(intention.action, self._history.step)
            intention = intention_of(intention.plan[1:], intention.believed)
        self._rest = intention

    def _hear(self, percept: Percept) -> None:
        history = self._history
        if percept.attempted is not None:
            history.happened(percept.attempted, percept.happened is not False, history.step)
        if percept.happened is False:
            self._rest = None  # whenever there will be time for another one

    def _trace(self, thought: Thought) -> Trace:
        trace = Trace(reason=thought.limit, plans=self._plans)
        trace = self._with_explanation(trace, thought)
        intention = thought.intention
        if intention is None:
            return trace
        believed = intention.believed - {GOAL}
        self._plans += thought.is_new and bool(intention.plan)
        is_given_up = not intention.plan and GOAL not in intention.believed
        no_plan, given_up = self._reasons.no_plan(believed) if is_given_up else (None, "")
        return structs.replace(
            trace,
            intention=intention.action,
            plan=list(intention.plan),
            belief=sorted(believed) if thought.is_new else [],
            reason=given_up or _why(thought.is_new, len(intention.plan)),
            no_plan=no_plan,
            plans=self._plans,
        )


class TraditionalReference(TraditionalRobot):
    """TP, each program solved from scratch."""

    _make_reasoner = ReferenceReasoner


def _why(is_new: bool, actions: int) -> str:
    """Why a plan of so many actions that reaches the goal is carried out."""
    if not actions:
        return "the goal holds" if is_new else "the plan is over"
    left = f"{actions} action{'' if actions == 1 else 's'}"
    return f"a new plan: {left} to the goal, none fewer" if is_new else f"{left} of the plan left"
