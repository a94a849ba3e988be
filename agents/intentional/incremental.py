"""The two phases of reasoning step by step: the answers of the theory solved from scratch."""

from __future__ import annotations

from dataclasses import dataclass, field, replace

from agents.intentional.history import History
from agents.intentional.reference import ReferenceReasoner
from agents.shared.sessions import sessions_of
from agents.shared.thought import Intention
from asp.reasoning.diagnosis import GOAL, Diagnosis, Explanation, IncrementalDiagnoser
from asp.reasoning.knowledge import Knowledge
from asp.solving import State

FIRST_EVENT = 1
"""The first step with events: nothing else happens while the goal is selected (16)."""


@dataclass
class _Active:
    """The active activity, with the physical actions that took effect since it was started."""

    name: int
    executed: list[tuple[int, str]] = field(default_factory=list)


class IncrementalReasoner(IncrementalDiagnoser[History]):
    """Reasons about one goal in one domain, as the reference does, for one trial."""

    def __init__(self, knowledge: Knowledge, goal: tuple[str, ...], plan_limit: int) -> None:
        """`plan_limit` is the greatest number of actions in a plan."""
        sessions = sessions_of(knowledge)
        reference = ReferenceReasoner(knowledge, goal, plan_limit)
        super().__init__(sessions.diagnosis, goal, FIRST_EVENT, reference)
        self._plans = sessions.plans
        self._actions, _ = knowledge.actions
        self._plan_limit = plan_limit
        self._active: _Active | None = None

    def diagnose(self, history: History, adopted: Explanation, /) -> Diagnosis:
        """Phase one. Raises InconsistentHistoryError."""
        self._follow(history)
        return replace(super().diagnose(history, adopted), indices=self._indices(history))

    def intend(self, history: History, diagnosis: Diagnosis, /) -> Intention:
        """Phase two."""
        state = self.belief.state
        holds = self.holds(state)
        action, plan = ("finish", ()) if holds else self._decide(state, history, diagnosis)
        return Intention(action, plan, state | {GOAL} if holds else state)

    def _decide(
        self, state: State, history: History, diagnosis: Diagnosis
    ) -> tuple[str, tuple[str, ...]]:
        """The intention where the goal does not hold."""
        for name, index in diagnosis.indices.items():
            left = history.activities[name - 1].plan[index:]
            if left and self._plans.succeeds(state, self._goal, left):
                return left[0], ()  # (38)
            return f"stop({name})", ()  # (41)
        plan = self._plans.shortest(state, self._goal, self._plan_limit)
        if plan is None:
            return "finish", ()  # (53)
        earlier = (activity.name for activity in history.activities if activity.plan == plan)
        return f"start({next(earlier, len(history.activities) + 1)})", plan  # (42), (52)

    def _follow(self, history: History) -> None:
        """Which activity is active after the last step (1), and what was done since it is."""
        last = history.at(history.step - 1)
        for action in last.attempted:
            kind, _, name = action.rstrip(")").partition("(")
            if kind == "start":
                self._active = _Active(int(name))
            elif kind == "stop":
                self._active = None
            elif self._active and action in self._actions and last.happened.get(action):
                done = (history.step - 1, action)
                if done not in self._active.executed:  # a step may be diagnosed twice
                    self._active.executed.append(done)

    def _indices(self, history: History) -> dict[int, int]:
        """The index of the active activity (3), which stood still where the goal held (7)-(9)."""
        if self._active is None:
            return {}
        plan, index = history.activities[self._active.name - 1].plan, 0
        held = self.belief.held
        for step, action in self._active.executed:
            if step not in held and plan[index : index + 1] == (action,):
                index += 1
        return {self._active.name: index}
