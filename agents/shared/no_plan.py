"""Why a robot has no plan: the goal is out of reach, or only beyond the limit of a plan.

What can be achieved is judged from what the robot believes, which need not be so. Nothing here has
a part in a decision.
"""

from __future__ import annotations

from collections.abc import Collection

from agents.shared.knowledge import Knowledge
from agents.shared.sessions import tools_of
from asp.solving import UNLIMITED, LimitError, Limits, deciding
from testbed.protocol import NoPlan


class GivingUp:
    """Tells why there is no plan for one goal in one domain."""

    def __init__(
        self,
        knowledge: Knowledge,
        goal: tuple[str, ...],
        plan_limit: int,
        limits: Limits = UNLIMITED,
    ) -> None:
        self._reach = tools_of(knowledge).reach
        self._goal = goal
        self._plan_limit = plan_limit
        self._limits = limits

    def why(self, believed: Collection[str]) -> tuple[NoPlan, str]:
        """Of a state for which no plan within the limit was found, as a key and in words."""
        within = f"no plan of at most {self._plan_limit} actions achieves the goal"
        match self._is_reachable(frozenset(believed)):
            case True:
                return "beyond the limit", f"{within}; from what it believes a longer one does"
            case False:
                said = "from what it believes, the goal is out of reach: no plan of any length"
                return "out of reach", f"{said} achieves it"
            case _:
                return "not known", f"{within}; whether a longer one does is not known"

    def _is_reachable(self, state: frozenset[str]) -> bool | None:
        try:
            with deciding(self._limits):
                return self._reach.reachable(state, self._goal)
        except LimitError:
            return None
