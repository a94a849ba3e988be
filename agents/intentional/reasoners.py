"""The two phases of reasoning of the intentional robot: from scratch, and step by step.

The `ReferenceReasoner` solves the theory of intentions, the `IncrementalReasoner` gives the same
answers on multi-shot sessions.
"""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import NamedTuple

from clingo import Symbol

from agents.shared import Intention, sessions_of
from asp.language import Action, Literal
from asp.reasoning import Knowledge, diagnosis
from asp.reasoning.diagnosis import (
    GOAL,
    Diagnosis,
    Explanation,
    IncrementalDiagnoser,
    ReferenceDiagnoser,
)
from asp.solving import fact, first_model, ground, literal_of, select, theory
from testbed.protocol import FINISH

BEYOND_LIMIT = (fact("beyond_limit"),)
"""What is given where no plan within the limit exists (53)."""


@dataclass(frozen=True)
class Activity:
    """A plan made for the goal: its name (1, 2, ...) and its physical actions."""

    name: int
    plan: tuple[Action, ...]


def start_activity(name: int) -> Action:
    """The mental action of starting an activity."""
    return Action.of("start", (str(name),))


def stop_activity(name: int) -> Action:
    """The mental action of stopping an activity."""
    return Action.of("stop", (str(name),))


@dataclass
class History(diagnosis.History):
    """What was observed and attempted at each step, and every activity so far."""

    activities: list[Activity] = field(default_factory=list)

    def activity_facts(self) -> Iterator[Symbol]:
        """What the theory knows of each activity: its goal, its components, its length."""
        for activity in self.activities:
            yield fact("activity_goal", activity.name, GOAL)
            yield fact("activity_length", activity.name, len(activity.plan))
            for index, action in enumerate(activity.plan, start=1):
                yield fact("activity_component", activity.name, index, action)

    def left(self, diagnosis: Diagnosis) -> tuple[Action, ...]:
        """What is left of the plan of the activity that is carried out."""
        name, index = next(iter(diagnosis.indices.items()))
        return self.activities[name - 1].plan[index:]

    @property
    def longest(self) -> int:
        """The length of the longest plan so far."""
        return max((len(activity.plan) for activity in self.activities), default=0)


class Program(NamedTuple):
    """The parts of a program: the description and theories by name, constants, facts."""

    texts: Mapping[str, str]
    constants: Mapping[str, int]
    facts: Sequence[Symbol]


class ReferenceReasoner(ReferenceDiagnoser[History]):
    """Reasons about one goal in one domain; every call solves its program from scratch."""

    theories = ("history", "intentions", "goal_persistence")

    def __init__(self, knowledge: Knowledge, goal: tuple[Literal, ...], plan_limit: int) -> None:
        """`plan_limit` is the greatest number of actions in a plan."""
        super().__init__(knowledge, goal)
        self._plan_limit = plan_limit

    def intend(self, history: History, diagnosis: Diagnosis, /) -> Intention:
        """Phase two, over a horizon that grows from the end of the activity in progress on.

        Where no activity is in progress this is iterative deepening: the first horizon with an
        intention is that of a shortest plan. Beyond the plan limit the goal is futile.
        """
        for length in self._lengths(history, diagnosis):
            intention = self._intention(history, diagnosis, length, ())
            if intention is not None:
                return intention
        intention = self._intention(history, diagnosis, 1, BEYOND_LIMIT)
        assert intention is not None, "(53): an agent always has an intention"
        return intention

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
        left = (len(history.activities[n - 1].plan) - i for n, i in diagnosis.indices.items())
        first = max([1, *left])
        return range(first, max(first, self._plan_limit) + 1)

    def _intention(
        self, history: History, diagnosis: Diagnosis, length: int, more: tuple[Symbol, ...]
    ) -> Intention | None:
        """The intention where `length` more physical actions are considered, if there is one."""
        program = self.phase_two(history, diagnosis, length, more)
        model = first_model(ground(program.texts.values(), program.constants, program.facts))
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
    plan = sorted((index.number, literal_of(step)) for _, index, step in select(started, "plan", 3))
    believed = frozenset(literal_of(fluent) for (fluent,) in select(model, "believed", 1))
    return Intention(literal_of(action), tuple(step for _, step in plan), believed)


FIRST_EVENT = 1
"""The first step with events: nothing else happens while the goal is selected (16)."""


class IncrementalReasoner(IncrementalDiagnoser[History]):
    """Reasons about one goal in one domain, as the reference does, for one trial."""

    def __init__(self, knowledge: Knowledge, goal: tuple[Literal, ...], plan_limit: int) -> None:
        """`plan_limit` is the greatest number of actions in a plan."""
        sessions = sessions_of(knowledge)
        reference = ReferenceReasoner(knowledge, goal, plan_limit)
        super().__init__(sessions.diagnosis, goal, FIRST_EVENT, reference)
        self._plans = sessions.plans
        self._actions, _ = knowledge.actions
        self._plan_limit = plan_limit
        self._active: int | None = None
        self._executed: list[tuple[int, Action]] = []

    def diagnose(self, history: History, adopted: Explanation, /) -> Diagnosis:
        """Phase one. Raises InconsistentHistoryError."""
        self._follow(history)
        return replace(super().diagnose(history, adopted), indices=self._indices(history))

    def intend(self, history: History, diagnosis: Diagnosis, /) -> Intention:
        """Phase two."""
        state = self.belief.state
        if self.holds(state):
            return Intention(FINISH, (), state | {GOAL})
        for name in diagnosis.indices:
            left = history.left(diagnosis)
            if left and self._plans.succeeds(state, self._goal, left):
                return Intention(left[0], (), state)  # (38)
            return Intention(stop_activity(name), (), state)  # (41)
        plan = self._plans.shortest(state, self._goal, self._plan_limit)
        if plan is None:
            return Intention(FINISH, (), state)  # (53)
        earlier = (activity.name for activity in history.activities if activity.plan == plan)
        name = next(earlier, len(history.activities) + 1)
        return Intention(start_activity(name), plan, state)  # (42), (52)

    def _follow(self, history: History) -> None:
        """Which activity is active after the last step (1), and what took effect since it is."""
        last = history.at(history.step - 1)
        for action in last.attempted:
            if action.name == "start":
                self._active, self._executed = int(action.arguments[0]), []
            elif action.name == "stop":
                self._active = None
            elif self._active and action in self._actions and last.happened.get(action):
                done = (history.step - 1, action)
                if done not in self._executed:  # a step may be diagnosed twice
                    self._executed.append(done)

    def _indices(self, history: History) -> dict[int, int]:
        """The index of the active activity (3), which stood still where the goal held (7)-(9)."""
        if self._active is None:
            return {}
        plan, index = history.activities[self._active - 1].plan, 0
        held = self.belief.held
        for step, action in self._executed:
            if step not in held and plan[index : index + 1] == (action,):
                index += 1
        return {self._active: index}
