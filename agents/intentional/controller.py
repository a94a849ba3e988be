"""The control loop AIA: interpret, intend, attempt, observe (D 2)."""

from collections.abc import Iterable
from typing import ClassVar

from msgspec import structs

from agents.intentional.activities import Activity, History, start_activity
from agents.intentional.heeding import HEEDING, Scene
from agents.intentional.programs import Decided, Watcher
from agents.intentional.reasoners import IncrementalReasoner, ReferenceReasoner
from agents.intentional.reasons import IntentionalReasons
from agents.shared import Intention, MakeReasoner, Reasoner, ReasoningRobot, Thought
from asp.language import Action, Literal
from asp.reasoning.diagnosis import GOAL, SELECT, Diagnosis
from testbed.protocol import FINISH, Capabilities, Percept, Task, Trace, is_mental


class IntentionalRobot(ReasoningRobot[History]):
    """A robot that reasons with the adapted theory of intentions (ATI)."""

    # At step 1 it starts an activity, or finishes.
    capabilities: ClassVar = Capabilities(
        knowledge=("complete", "seen"),
        plans=("optimistic", "conformant"),
        first_action_step=2,
        snapshots=True,
    )
    _reasons_type = IntentionalReasons
    _reasons: IntentionalReasons
    _make_reasoner: MakeReasoner[History] = IncrementalReasoner
    watcher: Watcher | None = None
    """Is told each decision before it is attempted."""

    def _begin(self, task: Task) -> None:
        """Selects the task's goal at step 0."""
        self._heeding = HEEDING[task.relevance](task)
        self._unheeded: list[Literal] = []
        self._ahead: tuple[Action, ...] = ()
        self._history = History()
        self._history.observe(task.initial, 0)
        self._history.happened(SELECT, True, 0)

    def _intend(self, reasoner: Reasoner[History], thought: Thought) -> Intention:
        intention = super()._intend(reasoner, thought)
        if intention.under is not None:
            thought.diagnosis, self._explanation = intention.under, intention.under.explanation
        diagnosis = thought.diagnosis
        assert diagnosis is not None
        if self.watcher is not None:
            self.watcher(Decided(self._domain, self._goal, self._history, diagnosis, intention))
        is_over = is_mental(intention.action) or intention.action == FINISH
        self._ahead = intention.plan if is_over else self._history.left(diagnosis.indices)
        return intention

    def _hear(self, percept: Percept) -> None:
        """Step 4 of the loop: the result of the last attempt, and of having finished."""
        history = self._history
        if percept.happened:
            self._ahead = self._ahead[1:]
        for attempted in history.at(history.step).attempted:
            # A mental action and finishing cannot fail; the world only answers physical ones.
            has_failed = attempted == percept.attempted and percept.happened is False
            history.happened(attempted, not has_failed, history.step)
            if has_failed and percept.failing:
                history.failed(attempted, history.step)
        if percept.goal_holds is not None:
            history.observe([GOAL if percept.goal_holds else GOAL.complement], history.step)

    def _relevant(self, percept: Percept) -> Iterable[Literal]:
        """Step 1 of the loop: what is relevant to the goal, or to the action at hand (P 3.2).

        Raises LimitError.
        """
        at_hand = percept.attempted or next(iter(self._ahead), None)
        scene = Scene(percept.visible, self._believed[1], at_hand, self._ahead)
        heeded = frozenset([*self._outcome(percept), *self._heeding.heeded(scene)])
        self._unheeded = [literal for literal in percept.visible if literal not in heeded]
        return [literal for literal in percept.visible if literal in heeded]

    def _attempt(self, intention: Intention) -> None:
        """Step 3 of the loop: the attempt is recorded, and a new activity with it."""
        history, believed = self._history, intention.believed - {GOAL}
        self._believed = (history.step, believed)
        self._expect(believed, self._ahead)
        history.attempt(intention.action, history.step)
        name = len(history.activities) + 1
        if intention.action == start_activity(name):
            history.activities.append(Activity(name, intention.plan))

    def _trace(self, thought: Thought) -> Trace:
        intention, diagnosis = thought.intention, thought.diagnosis
        trace = Trace(
            belief=sorted(self._believed[1]),
            reason=thought.limit,
            activity=None if diagnosis is None else max(diagnosis.indices, default=None),
            plans=len(self._history.activities),
        )
        if diagnosis is not None:
            trace = self._with_alternatives(self._with_explanation(trace, thought), diagnosis)
        if diagnosis is None or intention is None:
            return trace
        trace = structs.replace(
            trace,
            mental=intention.action if is_mental(intention.action) else None,
            intention=intention.action,
            plan=list(self._ahead),
            belief=sorted(intention.believed - {GOAL}),
            unheeded=[
                seen
                for seen in self._unheeded
                if (seen.atom in intention.believed) != seen.is_positive
            ],
            plans=trace.plans + (intention.action == start_activity(trace.plans + 1)),
        )
        return self._reasons.explained(trace, self._history, intention, diagnosis)

    def _with_alternatives(self, trace: Trace, diagnosis: Diagnosis) -> Trace:
        """The trace with the other explanations that are as small, if there is a new one."""
        if trace.explanation is None:
            return trace
        others, more = self._reasons.alternatives(self._history, diagnosis)
        return structs.replace(trace, alternatives=others, more_alternatives=more)


class Reference(IntentionalRobot):
    """ATI, each program solved from scratch."""

    _make_reasoner = ReferenceReasoner
