"""Diagnosis and planning without intentions: from scratch, and step by step."""

from agents.shared.sessions import sessions_of
from agents.shared.thought import Intention
from asp.language import Action, Fluent, Literal
from asp.reasoning.diagnosis import (
    GOAL,
    Diagnosis,
    History,
    IncrementalDiagnoser,
    ReferenceDiagnoser,
)
from asp.reasoning.knowledge import Knowledge, goal_facts
from asp.solving import first_model, ground, literal_of, select, theory
from testbed.protocol import FINISH


class ReferenceReasoner(ReferenceDiagnoser[History]):
    """Explains histories and plans for one goal; every call solves its program from scratch."""

    def __init__(self, knowledge: Knowledge, goal: tuple[Literal, ...], plan_limit: int) -> None:
        """`plan_limit` is the greatest number of actions in a plan."""
        super().__init__(knowledge, goal)
        self._known = (*knowledge.ranks, *knowledge.start)
        self._goal = tuple(goal_facts(goal))
        self._plan_limit = plan_limit

    def intend(self, history: History, diagnosis: Diagnosis, /) -> Intention:
        """To carry out a shortest plan, by iterative deepening; to finish where there is none."""
        texts = [*self._base, theory("traditional")]
        known = [*self._known, *history.facts(), *diagnosis.explanation.facts("explained")]
        for length in range(self._plan_limit + 1):
            constants = {"n": history.step + length}
            model = first_model(ground(texts, constants, [*known, *self._goal]))
            if model is not None:
                steps = sorted(
                    (i.number, literal_of(action)) for i, action in select(model, "plan", 2)
                )
                believed = (literal_of(fluent) for (fluent,) in select(model, "believed", 1))
                return intention_of(tuple(action for _, action in steps), frozenset(believed))
        model = first_model(ground(texts, {"n": history.step}, known))
        assert model is not None, "an explanation explains every step"
        believed = (literal_of(fluent) for (fluent,) in select(model, "believed", 1))
        return intention_of(None, frozenset(believed))


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
