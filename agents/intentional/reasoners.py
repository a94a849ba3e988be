"""The two phases of reasoning of the intentional robot: from scratch, and step by step.

The `ReferenceReasoner` solves the theory of intentions, the `IncrementalReasoner` gives the same
answers on multi-shot sessions.
"""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from itertools import chain, repeat
from typing import NamedTuple, Self

from clingo import Symbol

from agents.intentional.activities import History
from agents.intentional.options import Option, in_order, intended
from agents.shared import Conformant, Intention, outlook_of, sessions_of
from asp.language import Action
from asp.reasoning import Goal, Knowledge
from asp.reasoning.diagnosis import (
    Belief,
    Diagnosis,
    Explanation,
    IncrementalDiagnoser,
    ReferenceDiagnoser,
    diagnosis_of,
)
from asp.reasoning.planning import reference_conformant_planner
from asp.solving import answer_sets, fact, first_model, ground, literal_of, select, theory
from testbed.protocol import Plans

BEYOND_LIMIT = (fact("beyond_limit"),)
"""What is given where no plan within the limit exists (53)."""


class Program(NamedTuple):
    """The parts of a program: the description and theories by name, constants, facts."""

    texts: Mapping[str, str]
    constants: Mapping[str, int]
    facts: Sequence[Symbol]

    def model(self) -> tuple[Symbol, ...] | None:
        """The shown symbols of the preferred answer set; None: there is none."""
        return first_model(ground(self.texts.values(), self.constants, self.facts))


class ReferenceReasoner(ReferenceDiagnoser[History]):
    """Reasons about one goal in one domain; every call solves its program from scratch."""

    theories = ("history", "intentions", "goal_persistence")

    def __init__(
        self, knowledge: Knowledge, goal: Goal, plan_limit: int, plans: Plans = "optimistic"
    ) -> None:
        """`plan_limit` is the greatest number of actions in a plan."""
        super().__init__(knowledge, goal)
        self._knowledge = knowledge
        self._goal = goal
        self._plan_limit = plan_limit
        self._is_conformant = plans == "conformant" and not knowledge.deterministic

    def intend(self, history: History, diagnosis: Diagnosis, /) -> Intention:
        """Phase two, over a horizon that grows from the end of the activity in progress on.

        Where no activity is in progress this is iterative deepening: the first horizon with an
        intention is that of a shortest plan. Beyond the plan limit the goal is futile. Conformant
        plans are no part of the theory: they are looked for from every state that may be.
        """
        if self._is_conformant:
            outlook = Conformant(reference_conformant_planner(self._knowledge))
            options = self._options(history, diagnosis)
            return intended(options, history, diagnosis, outlook, self._goal, self._plan_limit)
        lengths = self._lengths(history, diagnosis)
        for length, more in chain(zip(lengths, repeat(())), [(1, BEYOND_LIMIT)]):
            intention = self._intention(history, diagnosis, length, more)
            if intention is not None:
                return intention
        raise AssertionError("(53): an agent always has an intention")

    def phase_two(
        self, history: History, diagnosis: Diagnosis, length: int, more: Sequence[Symbol] = ()
    ) -> Program:
        """The theory of planning where `length` more physical actions are considered.

        `more` is `beyond_limit` where no plan within the limit exists.
        """
        explanation = diagnosis.explanation
        facts = (
            *self._facts(history),
            fact("explanation", len(explanation.unobserved), history.step),
            *explanation.facts("explained"),
            *more,
        )
        names = ("description", *self.theories, "planning")
        texts = dict(zip(names, (*self._base, theory("planning")), strict=True))
        constants = self._constants(history, history.step + 1 + length, length)
        return Program(texts, constants, facts)

    def _lengths(self, history: History, diagnosis: Diagnosis) -> range:
        """How many more physical actions to consider, one number after the other."""
        left = len(history.left(diagnosis.indices))
        if not self._knowledge.deterministic:  # under other outcomes more of it may be left
            left = len(history.left(dict.fromkeys(diagnosis.indices, 0)))
        first = max(1, left)
        return range(first, max(first, self._plan_limit) + 1)

    def _intention(
        self, history: History, diagnosis: Diagnosis, length: int, more: tuple[Symbol, ...]
    ) -> Intention | None:
        """The intention where `length` more physical actions are considered, if there is one."""
        model = self.phase_two(history, diagnosis, length, more).model()
        if model is None or self._knowledge.deterministic:
            return None if model is None else read_intention(model)
        under = replace(diagnosis, indices=diagnosis_of(model).indices)
        return replace(read_intention(model), under=under)

    def _options(self, history: History, diagnosis: Diagnosis) -> list[Option]:
        """What may be so at the history's step, in the order of the fluents."""
        facts = [*self._facts(history), *diagnosis.explanation.facts("explained")]
        texts = [*self._base, theory("belief")]
        found, _ = answer_sets(ground(texts, self._constants(history, history.step), facts))
        known = self._knowledge.description.fluents
        options = []
        for shown in found:
            believed = [fluent for (fluent,) in select(shown, "believed", 1)]
            places = (f.arguments for f in believed if f.match("current_action_index", 2))
            active = {name.number: index.number for name, index in places if index.number >= 0}
            state = frozenset(map(literal_of, believed)).intersection(known)
            options.append(Option(state, active))
        return in_order(options, self._knowledge)

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
    plan = sorted((index.number, literal_of(step)) for _, index, step in select(started, "plan", 3))
    believed = frozenset(literal_of(fluent) for (fluent,) in select(model, "believed", 1))
    return Intention(literal_of(action), tuple(step for _, step in plan), believed)


FIRST_EVENT = 1
"""The first step with events: nothing else happens while the goal is selected (16)."""


class IncrementalReasoner(IncrementalDiagnoser[History]):
    """Reasons about one goal in one domain, as the reference does, for one trial."""

    def __init__(
        self, knowledge: Knowledge, goal: Goal, plan_limit: int, plans: Plans = "optimistic"
    ) -> None:
        """`plan_limit` is the greatest number of actions in a plan."""
        reference = ReferenceReasoner(knowledge, goal, plan_limit, plans)
        super().__init__(sessions_of(knowledge).diagnosis, goal, FIRST_EVENT, reference)
        self._outlook = outlook_of(knowledge, plans)
        self._actions, _ = knowledge.actions
        self._plan_limit = plan_limit
        self._active: int | None = None
        self._executed: list[tuple[int, Action]] = []
        self._followed = 0

    def copy(self) -> Self:
        other = super().copy()
        other._executed = [*self._executed]
        return other

    def diagnose(self, history: History, adopted: Explanation, /) -> Diagnosis:
        """Phase one. Raises InconsistentHistoryError."""
        self._follow(history)
        found = super().diagnose(history, adopted)
        return replace(found, indices=self._indices(history, self.belief))

    def intend(self, history: History, diagnosis: Diagnosis, /) -> Intention:
        """Phase two."""
        options = [Option(each.state, self._indices(history, each)) for each in self.beliefs]
        options = in_order(options, self._knowledge)
        limit = self._plan_limit
        return intended(options, history, diagnosis, self._outlook, self._goal, limit)

    def _follow(self, history: History) -> None:
        """Which activity is active (1), and what took effect since it is.

        A step may be diagnosed twice, or, where a limit is reached before, not at all.
        """
        for step in range(self._followed, history.step):
            moment = history.at(step)
            for action in moment.attempted:
                if action.name == "start":
                    self._active, self._executed = int(action.arguments[0]), []
                elif action.name == "stop":
                    self._active = None
                elif self._active and action in self._actions and moment.happened.get(action):
                    self._executed.append((step, action))
        self._followed = history.step

    def _indices(self, history: History, belief: Belief) -> dict[int, int]:
        """The index of the active activity (3), which stood still where the goal held (7)-(9)."""
        if self._active is None:
            return {}
        plan, index = history.activities[self._active - 1].plan, 0
        for step, action in self._executed:
            if step not in belief.held and plan[index : index + 1] == (action,):
                index += 1
        return {self._active: index}
