"""The two phases of reasoning at the coarse resolution: diagnose, then find the intention."""

from __future__ import annotations

from collections.abc import Iterator

from clingo import Symbol

from agents.intentional.history import History
from agents.shared.thought import Intention
from asp.reasoning.diagnosis import Diagnosis, Explanation, ReferenceDiagnoser
from asp.reasoning.knowledge import Knowledge
from asp.solving import fact, first_model, ground, select, theory


class ReferenceReasoner(ReferenceDiagnoser[History]):
    """Reasons about one goal in one domain; every call solves its program from scratch."""

    theories = ("history", "intentions", "persistence")

    def __init__(self, knowledge: Knowledge, goal: tuple[str, ...], plan_limit: int) -> None:
        """`plan_limit` is the greatest number of actions in a plan."""
        super().__init__(knowledge, goal)
        self._plan_limit = plan_limit

    def intend(self, history: History, diagnosis: Diagnosis, /) -> Intention:
        """Phase two, over a horizon that grows from the end of the activity in progress on.

        Where no activity is in progress this is iterative deepening: the first horizon with an
        intention is that of a shortest plan. Beyond the plan limit the goal is futile.
        """
        plans = {activity.name: len(activity.plan) for activity in history.activities}
        left = (plans[name] - index for name, index in diagnosis.indices.items())
        first = max([1, *left])
        for length in range(first, max(first, self._plan_limit) + 1):
            intention = self._intention(history, diagnosis.explanation, length, ())
            if intention is not None:
                return intention
        given_up = (fact("beyond_limit"),)
        intention = self._intention(history, diagnosis.explanation, 1, given_up)
        assert intention is not None, "(53): an agent always has an intention"
        return intention

    def _intention(
        self, history: History, explanation: Explanation, length: int, more: tuple[Symbol, ...]
    ) -> Intention | None:
        """The intention where `length` more physical actions are considered, if there is one."""
        constants = self._constants(history, history.step + 1 + length, length)
        facts = [
            *self._facts(history),
            fact("explanation", len(explanation.unobserved), history.step),
            *explanation.facts("explained"),
            *more,
        ]
        model = first_model(ground([*self._base, theory("planning")], constants, facts))
        return None if model is None else read_intention(model)

    def _facts(self, history: History) -> Iterator[Symbol]:
        yield from super()._facts(history)
        yield from history.activity_facts()

    def _constants(self, history: History, horizon: int, longest: int = 0, /) -> dict[str, int]:
        longest = max(1, longest, history.longest)
        return {"n": horizon, "max_name": len(history.activities) + 2, "max_len": longest}


def read_intention(model: tuple[Symbol, ...]) -> Intention:
    """What an answer set of the theory of planning says."""
    (action, _), *_ = select(model, "intended_action", 2)
    started = [symbol for symbol in model if action.match("start", 1) and symbol.match("plan", 3)]
    plan = sorted((index.number, str(step)) for _, index, step in select(started, "plan", 3))
    believed = frozenset(str(fluent) for (fluent,) in select(model, "believed", 1))
    return Intention(str(action), tuple(step for _, step in plan), believed)
