"""What is said of a trial by somebody who knows everything, as far as a budget of states goes."""

from __future__ import annotations

from collections.abc import Callable
from functools import lru_cache

from testbed.experiment.oracle import BudgetError
from testbed.experiment.record import Minimal, MinimalReason

MOST_ANSWERS = 4_096
"""How many answers are remembered: trials from the same state ask the same."""

Goal = tuple[str, ...]
Search = Callable[[int, Goal, int], int | None]
"""The least of something from a state to a goal within so many states, None where no plan exists.

It raises BudgetError.
"""


class Judge:
    """Answers questions about states of one world, each once."""

    def __init__(self, actions: Search, units: Search) -> None:
        self._actions, self._units = actions, units
        self._fewest = lru_cache(MOST_ANSWERS)(self._search)
        self.minimal = lru_cache(MOST_ANSWERS)(self._minimal)

    def in_reach(self, state: int, goal: Goal, most_states: int) -> bool | None:
        """Whether some plan achieves the goal from the state; None where the budget struck."""
        _, reason = self._fewest(state, goal, most_states)
        return None if reason == "budget" else reason is None

    def _search(
        self, state: int, goal: Goal, most_states: int
    ) -> tuple[int | None, MinimalReason | None]:
        """The fewest actions; where they are not known, why."""
        try:
            actions = self._actions(state, goal, most_states)
        except BudgetError:
            return None, "budget"
        return actions, "no plan" if actions is None else None

    def _minimal(self, state: int, goal: Goal, most_states: int) -> Minimal:
        """The least that achieves the goal from the state.

        Where the budget suffices for the actions and not for the units, only these are unknown.
        """
        actions, reason = self._fewest(state, goal, most_states)
        if actions is None:
            return Minimal(None, None, reason)
        try:
            return Minimal(actions, self._units(state, goal, most_states), None)
        except BudgetError:
            return Minimal(actions, None, None)
