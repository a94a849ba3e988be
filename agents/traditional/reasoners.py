"""Diagnosis and planning without intentions: from scratch, and step by step."""

from agents.shared import Intention, sessions_of
from asp.language import Action, Fluent, Literal
from asp.reasoning import Knowledge
from asp.reasoning.diagnosis import (
    GOAL,
    Diagnosis,
    History,
    IncrementalDiagnoser,
    ReferenceDiagnoser,
)
from asp.reasoning.planning import ReferencePlanner
from asp.solving import first_model, ground, literal_of, select, theory
from testbed.protocol import FINISH


class ReferenceReasoner(ReferenceDiagnoser[History]):
    """Explains histories and plans for one goal; every call solves its program from scratch."""

    def __init__(self, knowledge: Knowledge, goal: tuple[Literal, ...], plan_limit: int) -> None:
        """`plan_limit` is the greatest number of actions in a plan."""
        super().__init__(knowledge, goal)
        self._goal = goal
        self._planner = ReferencePlanner(knowledge)
        self._plan_limit = plan_limit

    def intend(self, history: History, diagnosis: Diagnosis, /) -> Intention:
        """To carry out a shortest plan from what is believed; to finish where there is none."""
        facts = [*self._facts(history), *diagnosis.explanation.facts("explained")]
        texts = [*self._base, theory("belief")]
        model = first_model(ground(texts, self._constants(history, history.step), facts))
        assert model is not None, "an explanation explains every step"
        state = frozenset(literal_of(fluent) for (fluent,) in select(model, "believed", 1))
        if all((literal.atom in state) == literal.is_positive for literal in self._goal):
            return intention_of((), state)
        return intention_of(self._planner.shortest(state, self._goal, self._plan_limit), state)


def intention_of(plan: tuple[Action, ...] | None, believed: frozenset[Fluent]) -> Intention:
    """To carry out a plan of which so many actions are left; None: there is no plan."""
    if plan:
        return Intention(plan[0], plan, believed)
    return Intention(FINISH, (), believed if plan is None else believed | {GOAL})


# No goal is selected, so that something may happen at once.
_FIRST_EVENT = 0


class IncrementalReasoner(IncrementalDiagnoser[History]):
    """Explains one history and plans for one goal, as the reference does, for one trial."""

    def __init__(self, knowledge: Knowledge, goal: tuple[Literal, ...], plan_limit: int) -> None:
        """`plan_limit` is the greatest number of actions in a plan."""
        sessions = sessions_of(knowledge)
        reference = ReferenceReasoner(knowledge, goal, plan_limit)
        super().__init__(sessions.diagnosis, goal, _FIRST_EVENT, reference)
        self._plans = sessions.plans
        self._plan_limit = plan_limit

    def intend(self, _history: History, _diagnosis: Diagnosis, /) -> Intention:
        """To carry out a shortest plan from what is believed; to finish where there is none."""
        state = self.belief.state
        if self.holds(state):
            return intention_of((), state)
        return intention_of(self._plans.shortest(state, self._goal, self._plan_limit), state)
