"""Diagnosis and planning without intentions, on kept controls."""

from __future__ import annotations

from agents.shared.believing import Believer
from agents.shared.diagnosis import Explained
from agents.shared.history import Diagnosis, History
from agents.shared.knowledge import Knowledge
from agents.shared.sessions import tools_of
from agents.traditional.reference import Plan, Planner

# No goal is selected, so that something may happen at once.
_FIRST_EVENT = 0


class KeptPlanner:
    """Explains one history and plans for one goal, as `Planner` does, for one trial."""

    def __init__(self, knowledge: Knowledge, goal: tuple[str, ...], plan_limit: int) -> None:
        """`plan_limit` is the greatest number of actions in a plan."""
        plain = Planner(knowledge, goal, plan_limit)
        self._plans = tools_of(knowledge).plans
        self._goal = goal
        self._plan_limit = plan_limit
        self._believer = Believer(
            knowledge,
            goal,
            _FIRST_EVENT,
            lambda history, adopted: plain.diagnose(history, adopted).diagnosis,
        )

    def diagnose(self, history: History, adopted: Diagnosis) -> Explained:
        """The smallest explanation. Raises InconsistentHistoryError."""
        diagnosis, kept = self._believer.diagnose(history, adopted)
        return Explained(diagnosis, kept, {})

    def plan(self, _history: History, _diagnosis: Diagnosis, /) -> Plan:
        """A shortest plan from what the diagnosis implies; an empty one where there is none."""
        state = self._believer.belief.state
        if self._believer.holds(state):
            return Plan((), tuple(sorted(state)), reachable=True)
        plan = self._plans.shortest(state, self._goal, self._plan_limit)
        if plan is None:
            return Plan((), tuple(sorted(state)), reachable=False)
        return Plan(plan, tuple(sorted(state)), reachable=True)
