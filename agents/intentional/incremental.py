"""The two phases of reasoning on kept controls: the answers of the theory solved from scratch."""

from __future__ import annotations

from dataclasses import dataclass, field
from functools import partial

from agents.intentional.intention import Intention
from agents.intentional.reference import Logician
from agents.shared.believing import Believer
from agents.shared.diagnosis import Explained
from agents.shared.history import GOAL, Diagnosis, History
from agents.shared.knowledge import Knowledge
from agents.shared.memory import PACE
from agents.shared.sessions import tools_of
from asp.reasoning.diagnosis import Pace
from asp.solving import State

# (16): nothing else happens while the goal is selected.
_FIRST_EVENT = 1


@dataclass
class _Active:
    """The active activity, with the physical actions that took effect since it was started."""

    name: int
    executed: list[tuple[int, str]] = field(default_factory=list)


class KeptLogician:
    """Reasons about one goal in one domain, as `Logician` does, for one trial."""

    def __init__(
        self,
        knowledge: Knowledge,
        goal: tuple[str, ...],
        plan_limit: int,
        pace: Pace = PACE,
    ) -> None:
        """`plan_limit` is the greatest number of actions in a plan."""
        plain = Logician(knowledge, goal, plan_limit)
        self._plans = tools_of(knowledge).plans
        self._actions = frozenset(knowledge.description.agent_actions)
        self._goal = goal
        self._plan_limit = plan_limit
        self._active: _Active | None = None
        self._believer = Believer(
            knowledge,
            goal,
            _FIRST_EVENT,
            lambda history, adopted: plain.diagnose(history, adopted).diagnosis,
            pace,
        )

    def diagnose(self, history: History, adopted: Diagnosis) -> Explained:
        """Phase one. Raises InconsistentHistoryError."""
        self._follow(history)
        diagnosis, kept = self._believer.diagnose(history, adopted)
        others = partial(self._believer.alternatives, history, diagnosis)
        return Explained(diagnosis, kept, self._indices(history), others)

    def intend(self, history: History, explained: Explained) -> Intention:
        """Phase two."""
        state = self._believer.belief.state
        holds = self._believer.holds(state)
        action, plan = ("finish", ()) if holds else self._decide(state, history, explained)
        return Intention(action, plan, state | {GOAL} if holds else state)

    def _decide(
        self, state: State, history: History, explained: Explained
    ) -> tuple[str, tuple[str, ...]]:
        """The intention where the goal does not hold."""
        for name, index in explained.indices.items():
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
        held = self._believer.belief.held
        for step, action in self._active.executed:
            if step not in held and plan[index : index + 1] == (action,):
                index += 1
        return {self._active.name: index}
