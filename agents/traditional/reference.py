"""Diagnosis and planning without intentions, solved from scratch."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

from clingo import Symbol

from agents.shared.diagnosis import Explained, diagnose
from agents.shared.history import Diagnosis, History
from agents.shared.knowledge import Knowledge, goal_facts
from asp.solving import first_model, ground, select, theory


@dataclass(frozen=True)
class Plan:
    """The actions that are left and what is believed now; `reachable` if they reach the goal."""

    actions: tuple[str, ...]
    believed: tuple[str, ...]
    reachable: bool


class Planner:
    """Explains histories and plans for one goal; every call solves its program from scratch."""

    def __init__(self, knowledge: Knowledge, goal: tuple[str, ...], plan_limit: int) -> None:
        """`plan_limit` is the greatest number of actions in a plan."""
        self._base = (knowledge.program, theory("history"))
        self._given = (*knowledge.ranks, *knowledge.start)
        self._goal = tuple(goal_facts(goal))
        self._plan_limit = plan_limit

    def diagnose(self, history: History, adopted: Diagnosis) -> Explained:
        """The smallest explanation. Raises InconsistentHistoryError."""
        constants = {"n": history.step}
        return diagnose(self._base, constants, self._facts(history), history, adopted)

    def plan(self, history: History, diagnosis: Diagnosis) -> Plan:
        """A shortest plan, by iterative deepening; an empty one where there is none."""
        texts = [*self._base, theory("traditional")]
        known = [*self._given, *history.facts(), *diagnosis.facts("explained")]
        facts = [*known, *self._goal]
        for length in range(self._plan_limit + 1):
            model = first_model(ground(texts, {"n": history.step + length}, facts))
            if model is not None:
                return _read(model)
        model = first_model(ground(texts, {"n": history.step}, known))
        assert model is not None, "an explanation explains every step"
        return Plan((), _read(model).believed, reachable=False)

    def _facts(self, history: History) -> Iterator[Symbol]:
        yield from self._given
        yield from self._goal
        yield from history.facts()


def _read(model: tuple[Symbol, ...]) -> Plan:
    steps = sorted((index.number, str(action)) for index, action in select(model, "plan", 2))
    believed = sorted(str(fluent) for (fluent,) in select(model, "believed", 1))
    return Plan(tuple(action for _, action in steps), tuple(believed), reachable=True)
