"""How plans are judged where actions have several outcomes: by some of them, or by all."""

from collections.abc import Sequence
from typing import NamedTuple, Protocol

from asp.reasoning import Goal, satisfied
from asp.reasoning.planning import ConformantPlanner, Plan, Planner
from asp.solving import State


class Course(NamedTuple):
    """A state in which a robot may be, and a plan, or what is left of one there."""

    state: State
    left: Plan


class Outlook(Protocol):
    """Judges what may be so; of several states the first one that bears it out is believed."""

    def achieved(self, states: Sequence[State], goal: Goal) -> State | None:
        """The state to be believed if the goal counts as achieved; else None."""

    def succeeding(self, courses: Sequence[Course], goal: Goal) -> Course | None:
        """The course to be believed if the plans that are left count as successful; else None."""

    def shortest(self, states: Sequence[State], goal: Goal, limit: int) -> Course | None:
        """The state to be believed, and a shortest plan of at most `limit` actions, if any."""


class Optimistic:
    """Judges by the best of all outcomes."""

    def __init__(self, plans: Planner) -> None:
        self._plans = plans

    def achieved(self, states: Sequence[State], goal: Goal) -> State | None:
        """The first state that satisfies the goal."""
        return next((state for state in states if satisfied(goal, state)), None)

    def succeeding(self, courses: Sequence[Course], goal: Goal) -> Course | None:
        """The first one that may reach the goal."""
        for state, left in courses:
            if left and not satisfied(goal, state) and self._plans.succeeds(state, goal, left):
                return Course(state, left)
        return None

    def shortest(self, states: Sequence[State], goal: Goal, limit: int) -> Course | None:
        """The first state from which fewest actions may reach the goal."""
        best: Course | None = None
        for state in states:
            plan = self._plans.shortest(state, goal, limit)
            if plan is not None:
                best, limit = Course(state, plan), len(plan) - 1
            if limit == 0:
                break
        return best


class Conformant:
    """Judges by the worst of all outcomes; of the states the first one is believed."""

    def __init__(self, plans: ConformantPlanner) -> None:
        self._plans = plans

    def achieved(self, states: Sequence[State], goal: Goal) -> State | None:
        """The first state, if all satisfy the goal."""
        return states[0] if all(satisfied(goal, state) for state in states) else None

    def succeeding(self, courses: Sequence[Course], goal: Goal) -> Course | None:
        """The first one, if all have the same plan left, and it reaches the goal from all."""
        left, states = courses[0].left, [course.state for course in courses]
        is_same = all(course.left == left for course in courses)
        return courses[0] if is_same and self._plans.succeeds(states, goal, left) else None

    def shortest(self, states: Sequence[State], goal: Goal, limit: int) -> Course | None:
        """A shortest plan that reaches the goal from all states."""
        plan = self._plans.shortest(states, goal, limit)
        return None if plan is None else Course(states[0], plan)
