"""What a step of a game is worth to both agents, by the rules of its rewards."""

from collections.abc import Mapping
from functools import lru_cache
from typing import Any

from testbed.environment.rules import ADVERSARY, ILLEGAL_REWARD, ROBOT, Rules, Situation, rewards
from testbed.protocol import NONE
from testbed.search import BudgetError, Goal, Pose, cheapest_plan, least_knowing

MOST_ANSWERS = 65_536
"""Of how many states the remaining cost is remembered."""


class Payoff:
    """The rewards of a game; its searches look at `rules.search_states` states at most.

    `costs` are execution units; where no action has any, each costs 1.
    """

    def __init__(self, rules: Rules, pose: Pose, costs: Mapping[str, int]) -> None:
        self._rules, self._pose = rules, pose
        self.costs = costs if any(costs.values()) else dict.fromkeys(costs, 1)
        self._remaining = lru_cache(MOST_ANSWERS)(self._fewest)

    def __reduce__(self) -> tuple[Any, ...]:
        """Copies begin without what is remembered."""
        return type(self), (self._rules, self._pose, self.costs)

    def __call__(self, now: Situation) -> dict[str, float]:
        """The rewards of the step that led here; before any step those are 0."""
        if now.answer is None:
            return rewards(None)
        ours = self._rules.rewards
        robot = rewards(now.ending)[ROBOT] - ours.step
        if ours.shaping:
            robot += ours.shaping * self._progress(now)
        paid = 0.0 if now.event == NONE else self._rules.adversary.cost
        return {ROBOT: robot, ADVERSARY: self._of_adversary(now, robot) - paid}

    def of_illegal(self, now: Situation, agent: str) -> dict[str, float]:
        """The rewards where an illegal answer of the agent ends the game in place of a step.

        The goal, events and units count for nothing. Shaping ends as it does at any end, so that
        its sum does not depend on how the game ends.
        """
        earned = {own: ILLEGAL_REWARD if own == agent else 0.0 for own in (ROBOT, ADVERSARY)}
        ours = self._rules.rewards
        if ours.shaping:
            shaped = -ours.shaping * self.potential(now.state, now.goal)
            earned[ROBOT] += shaped
            earned[ADVERSARY] -= shaped if ours.adversary == "zero_sum" else 0.0
        return earned

    def potential(self, state: int, goal: Goal) -> float:
        """Minus the fewest units that the goal still takes.

        Where it is out of reach, or the search's bound strikes, minus the most that the steps of a
        game can cost.
        """
        fewest = self._remaining(state, goal)
        most = self._rules.steps * max(self.costs.values(), default=0)
        return -float(most if fewest is None else fewest)

    def _progress(self, now: Situation) -> float:
        """By how much the potential rose; after the end it is 0."""
        assert now.before is not None
        before = self.potential(now.before, now.goal)
        after = 0.0 if now.ending is not None else self.potential(now.state, now.goal)
        return self._rules.rewards.discount * after - before

    def _of_adversary(self, now: Situation, robot: float) -> float:
        kind = self._rules.rewards.adversary
        if kind == "zero_sum":
            return 0.0 - robot
        if now.ending is None:
            return 0.0
        if kind == "fail":
            return float(now.in_reach and rewards(now.ending)[ROBOT] < 0)
        fewest = self._remaining(now.start, now.goal) if kind == "waste" else self._knowing(now)
        return 0.0 if fewest is None else float(max(0, now.units - fewest))

    def _fewest(self, state: int, goal: Goal) -> int | None:
        """The fewest units that achieve the goal; None where there are none, or it is not known."""
        problem, most = self._pose(state, goal), self._rules.search_states
        try:
            plan = cheapest_plan(problem, self.costs, most)
        except BudgetError:
            return None
        return None if plan is None else sum(map(self.costs.__getitem__, plan))

    def _knowing(self, now: Situation) -> int | None:
        """The same from the start, for who knows which events happened, and when."""
        problem, most = self._pose(now.start, now.goal), self._rules.search_states
        try:
            return least_knowing(problem, now.played, self.costs, most)
        except BudgetError:
            return None
