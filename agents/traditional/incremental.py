"""Diagnosis and planning without intentions, step by step."""

from __future__ import annotations

from agents.shared.sessions import sessions_of
from agents.shared.thought import Intention
from agents.traditional.reference import ReferenceReasoner, intention_of
from asp.reasoning.diagnosis import Diagnosis, History, IncrementalDiagnoser
from asp.reasoning.knowledge import Knowledge

# No goal is selected, so that something may happen at once.
_FIRST_EVENT = 0


class IncrementalReasoner(IncrementalDiagnoser[History]):
    """Explains one history and plans for one goal, as the reference does, for one trial."""

    def __init__(self, knowledge: Knowledge, goal: tuple[str, ...], plan_limit: int) -> None:
        """`plan_limit` is the greatest number of actions in a plan."""
        sessions = sessions_of(knowledge)
        reference = ReferenceReasoner(knowledge, goal, plan_limit)
        super().__init__(sessions.diagnosis, goal, _FIRST_EVENT, reference)
        self._plans = sessions.plans
        self._plan_limit = plan_limit

    def intend(self, _history: History, _diagnosis: Diagnosis, /) -> Intention:
        """To carry out a shortest plan from what is believed; to finish where there is none."""
        state = self.belief.state
        if self.holds(state):
            return intention_of((), state)
        return intention_of(self._plans.shortest(state, self._goal, self._plan_limit), state)
