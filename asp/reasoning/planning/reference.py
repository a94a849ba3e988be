"""Shortest plans from scratch, to which incremental planning is held equal."""

from typing import Protocol

from asp.language import Action
from asp.reasoning.knowledge import Goal, Knowledge, goal_facts
from asp.solving import State, fact, first_model, ground, literal_of, select, theory

Plan = tuple[Action, ...]
"""Actions, one after the other."""


class Planner(Protocol):
    """Shortest plans of a domain from complete states."""

    def shortest(self, state: State, goal: Goal, limit: int) -> Plan | None:
        """The first of the shortest plans of at most `limit` actions, or None.

        Earlier actions count before later ones, at one step the action declared first. The goal
        does not hold in the state. Raises LimitError.
        """

    def succeeds(self, state: State, goal: Goal, plan: Plan) -> bool:
        """Whether the goal holds after some of the plan's actions, all possible until then (36)."""


class ReferencePlanner:
    """`Planner` by the theory `shortest_plan.lp`, solved anew for every length."""

    def __init__(self, knowledge: Knowledge) -> None:
        self._texts = knowledge.program, theory("shortest_plan")
        self._ranks = knowledge.ranks

    def shortest(self, state: State, goal: Goal, limit: int) -> Plan | None:
        """The first of the shortest plans of at most `limit` actions, or None."""
        return next(filter(None, (self._found(state, goal, n) for n in range(1, limit + 1))), None)

    def succeeds(self, state: State, goal: Goal, plan: Plan) -> bool:
        """Whether the goal holds after some of the plan's actions, all possible until then (36)."""
        return any(self._found(state, goal, n, plan[:n]) for n in range(1, len(plan) + 1))

    def _found(self, state: State, goal: Goal, length: int, given: Plan = ()) -> Plan | None:
        """The first plan of exactly so many actions that begins with given ones."""
        facts = [*self._ranks, *goal_facts(goal), *(fact("starts", f) for f in sorted(state))]
        facts += (fact("occurs", action, step) for step, action in enumerate(given))
        model = first_model(ground(self._texts, {"n": length}, facts))
        if model is None:
            return None
        steps = sorted((i.number, literal_of(a)) for i, a in select(model, "plan", 2))
        return tuple(action for _, action in steps)
