"""The two phases of reasoning at the coarse resolution: diagnose, then find the intention."""

from __future__ import annotations

from collections.abc import Iterator

from clingo import Symbol

from agents.intentional.intention import Intention
from agents.shared.diagnosis import Explained, diagnose
from agents.shared.history import Diagnosis, History
from agents.shared.knowledge import Knowledge, goal_facts
from asp.solving import fact, first_model, ground, select, theory


class Logician:
    """Reasons about one goal in one domain; every call solves its program from scratch."""

    def __init__(self, knowledge: Knowledge, goal: tuple[str, ...], plan_limit: int) -> None:
        """`plan_limit` is the greatest number of actions in a plan."""
        acting = (theory("history"), theory("intentions"), theory("persistence"))
        self._base = (knowledge.program, *acting)
        self._given = (*knowledge.ranks, *knowledge.start, *goal_facts(goal))
        self._plan_limit = plan_limit

    def diagnose(self, history: History, adopted: Diagnosis) -> Explained:
        """Phase one. Raises InconsistentHistoryError."""
        return self._explained(history, adopted, keeps=True)

    def _explained(self, history: History, adopted: Diagnosis, keeps: bool) -> Explained:
        constants = self._constants(history, history.step, history.longest)
        facts = self._facts(history)
        return diagnose(self._base, constants, facts, history, adopted, keeps)

    def intend(self, history: History, explained: Explained) -> Intention:
        """Phase two, over a horizon that grows from the end of the activity in progress on.

        Where no activity is in progress this is iterative deepening: the first horizon with an
        intention is that of a shortest plan. Beyond the plan limit the goal is futile.
        """
        first = max(1, self._remaining(history, explained))
        for length in range(first, max(first, self._plan_limit) + 1):
            intention = self._intention(history, explained.diagnosis, length, ())
            if intention is not None:
                return intention
        intention = self._intention(history, explained.diagnosis, 1, (fact("beyond_limit"),))
        assert intention is not None, "(53): an agent always has an intention"
        return intention

    def _intention(
        self, history: History, diagnosis: Diagnosis, length: int, more: tuple[Symbol, ...]
    ) -> Intention | None:
        """The intention where `length` more physical actions are considered, if there is one."""
        horizon = history.step + 1 + length
        constants = self._constants(history, horizon, max(history.longest, length))
        facts = [
            *self._facts(history),
            fact("explanation", len(diagnosis.unobserved), history.step),
            *diagnosis.facts("explained"),
            *more,
        ]
        model = first_model(ground([*self._base, theory("planning")], constants, facts))
        return None if model is None else read_intention(model)

    def _facts(self, history: History) -> Iterator[Symbol]:
        yield from self._given
        yield from history.facts()
        yield from history.activity_facts()

    def _constants(self, history: History, horizon: int, longest: int) -> dict[str, int]:
        return {"n": horizon, "max_name": len(history.activities) + 2, "max_len": max(1, longest)}

    def _remaining(self, history: History, explained: Explained) -> int:
        """How many actions the active activity still has."""
        plans = {activity.name: len(activity.plan) for activity in history.activities}
        return max((plans[name] - index for name, index in explained.indices.items()), default=0)


def read_intention(model: tuple[Symbol, ...]) -> Intention:
    """What an answer set of the theory of planning says."""
    (action, _), *_ = select(model, "intended_action", 2)
    started = [symbol for symbol in model if action.match("start", 1) and symbol.match("plan", 3)]
    plan = sorted((index.number, str(step)) for _, index, step in select(started, "plan", 3))
    believed = frozenset(str(fluent) for (fluent,) in select(model, "believed", 1))
    return Intention(str(action), tuple(step for _, step in plan), believed)
