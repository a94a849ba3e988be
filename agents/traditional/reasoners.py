"""Diagnosis and planning without intentions: from scratch, and step by step."""

from agents.shared import Conformant, Intention, Optimistic, Outlook, outlook_of, sessions_of
from asp.language import Action, Fluent
from asp.reasoning import Goal, Knowledge, in_order
from asp.reasoning.diagnosis import (
    GOAL,
    Diagnosis,
    History,
    IncrementalDiagnoser,
    ReferenceDiagnoser,
)
from asp.reasoning.planning import ReferencePlanner, reference_conformant_planner
from asp.solving import State, answer_sets, ground, literal_of, select, theory
from testbed.protocol import FINISH, Plans


class ReferenceReasoner(ReferenceDiagnoser[History]):
    """Explains histories and plans for one goal; every call solves its program from scratch."""

    def __init__(
        self, knowledge: Knowledge, goal: Goal, plan_limit: int, plans: Plans = "optimistic"
    ) -> None:
        """`plan_limit` is the greatest number of actions in a plan."""
        super().__init__(knowledge, goal)
        self._goal = goal
        self._fluents = knowledge.description.fluents
        self._outlook: Outlook = Optimistic(ReferencePlanner(knowledge))
        if plans == "conformant" and not knowledge.deterministic:
            self._outlook = Conformant(reference_conformant_planner(knowledge))
        self._plan_limit = plan_limit

    def intend(self, history: History, diagnosis: Diagnosis, /) -> Intention:
        """To carry out a shortest plan from what is believed; to finish where there is none."""
        facts = [*self._facts(history), *diagnosis.explanation.facts("explained")]
        texts = [*self._base, theory("belief")]
        found, _ = answer_sets(ground(texts, self._constants(history, history.step), facts))
        states = {
            frozenset(literal_of(fluent) for (fluent,) in select(shown, "believed", 1))
            for shown in found
        }
        assert states, "an explanation explains every step"
        return _intended(
            in_order(states, self._fluents), self._outlook, self._goal, self._plan_limit
        )


def _intended(states: list[State], outlook: Outlook, goal: Goal, limit: int) -> Intention:
    """The intention where one of the states is so."""
    achieved = outlook.achieved(states, goal)
    if achieved is not None:
        return intention_of((), achieved)
    found = outlook.shortest(states, goal, limit)
    return intention_of(None, states[0]) if found is None else intention_of(found.left, found.state)


def intention_of(plan: tuple[Action, ...] | None, believed: frozenset[Fluent]) -> Intention:
    """To carry out a plan of which so many actions are left; None: there is no plan."""
    if plan:
        return Intention(plan[0], plan, believed)
    return Intention(FINISH, (), believed if plan is None else believed | {GOAL})


# No goal is selected, so that something may happen at once.
_FIRST_EVENT = 0


class IncrementalReasoner(IncrementalDiagnoser[History]):
    """Explains one history and plans for one goal, as the reference does, for one trial."""

    def __init__(
        self, knowledge: Knowledge, goal: Goal, plan_limit: int, plans: Plans = "optimistic"
    ) -> None:
        """`plan_limit` is the greatest number of actions in a plan."""
        reference = ReferenceReasoner(knowledge, goal, plan_limit, plans)
        super().__init__(sessions_of(knowledge).diagnosis, goal, _FIRST_EVENT, reference)
        self._outlook = outlook_of(knowledge, plans)
        self._plan_limit = plan_limit

    def intend(self, _history: History, _diagnosis: Diagnosis, /) -> Intention:
        """To carry out a shortest plan from what is believed; to finish where there is none."""
        states = list(dict.fromkeys(belief.state for belief in self.beliefs))
        return _intended(states, self._outlook, self._goal, self._plan_limit)
