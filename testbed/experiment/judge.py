"""The judge of trials: the fewest actions, and units, that achieve a goal, known completely."""

from collections.abc import Mapping, Sequence
from functools import lru_cache

from asp.language import Action
from testbed.experiment.record import Minimal
from testbed.search import BudgetError, Goal, Pose, cheapest_plan, least_knowing

MOST_ANSWERS = 4_096
"""How many answers are remembered: trials from the same state ask the same."""


class Judge:
    """Answers questions about states of one world, each once."""

    def __init__(self, problem: Pose, costs: Mapping[str, int]) -> None:
        """`problem` gives what is searched for a state and a goal; `costs` are execution units."""
        self._problem, self._costs = problem, costs
        self._fewest = lru_cache(MOST_ANSWERS)(self._search)
        self.minimal = lru_cache(MOST_ANSWERS)(self._minimal)

    def in_reach(self, state: int, goal: Goal, most_states: int) -> bool | None:
        """Whether some plan achieves the goal from the state; None where the budget struck."""
        reason = self._fewest(state, goal, most_states).reason
        return None if reason == "budget" else reason is None

    def knowing(
        self, state: int, goal: Goal, events: Sequence[tuple[int, Action]], most_states: int
    ) -> int | None:
        """The fewest units that achieve the goal for who knows the events and their steps.

        None where there is no plan, the budget does not suffice, or the events are not of the
        world that is searched.
        """
        if not events:
            return self.minimal(state, goal, most_states).units
        problem = world, *_ = self._problem(state, goal)
        if not {event for _, event in events} <= {*world.exogenous_actions}:
            return None
        try:
            return least_knowing(problem, events, self._costs, most_states)
        except BudgetError:
            return None

    def _search(self, state: int, goal: Goal, most_states: int) -> Minimal:
        """The fewest actions, without their units; where they are not known, why."""
        try:
            plan = cheapest_plan(self._problem(state, goal), most_states=most_states)
        except BudgetError:
            return Minimal(None, None, "budget")
        return Minimal(None, None, "no plan") if plan is None else Minimal(len(plan), None, None)

    def _minimal(self, state: int, goal: Goal, most_states: int) -> Minimal:
        """The least that achieves the goal from the state.

        Where the budget suffices for the actions and not for the units, only these are unknown.
        """
        fewest = self._fewest(state, goal, most_states)
        if fewest.actions is None:
            return fewest
        try:
            plan = cheapest_plan(self._problem(state, goal), self._costs, most_states)
        except BudgetError:
            return fewest
        return fewest._replace(units=sum(self._costs.get(own, 0) for own in plan or ()))
