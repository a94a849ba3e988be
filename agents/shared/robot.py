"""The turn of a step that reasoning robots share: observe, diagnose, intend, tell, attempt."""

from abc import ABC, abstractmethod
from collections.abc import Callable, Iterable
from copy import copy
from typing import ClassVar, Generic, Self

from msgspec import structs

from agents.shared.expectations import Expectations
from agents.shared.reasoning import Intention, Reasoner, limits_of
from agents.shared.reasons import Reasons
from agents.shared.thought import Thought
from asp.language import Action, Literal
from asp.reasoning import Knowledge, knowledge
from asp.reasoning.diagnosis import (
    GOAL,
    Diagnosis,
    Explanation,
    H_contra,
    Happening,
    InconsistentHistoryError,
    distrust_tests,
)
from asp.solving import LimitError, State, deciding, preparation, reasoning_clock
from testbed.protocol import WAIT, Decision, Percept, Plans, RobotStops, Task, Trace, is_mental

MakeReasoner = Callable[[Knowledge, tuple[Literal, ...], int, Plans], Reasoner[H_contra]]
"""Makes a reasoner of a domain, a goal, the greatest length of a plan, and which plans will do."""
_GROWING = ("_history", "_reasoner", "_expectations")
"""The attributes of a robot whose values change in a trial; others get new values."""


class ReasoningRobot(ABC, Generic[H_contra]):
    """A robot that keeps a history of a trial and reasons about it in two phases.

    `reasoner` makes what it reasons with, in place of the reasoner of its class. For snapshots this
    has a method `copy`: a reasoner that has come as far in its history, which may go on otherwise.
    """

    _reasons_type: ClassVar[type[Reasons]] = Reasons
    _make_reasoner: MakeReasoner[H_contra]
    _history: H_contra

    def __init__(self, reasoner: MakeReasoner[H_contra] | None = None) -> None:
        if reasoner is not None:
            self._make_reasoner = reasoner

    def begin(self, task: Task) -> None:
        """Takes the task on, and knows `task.initial` of step 0."""
        began = reasoning_clock()
        with deciding(), preparation():
            self._task = task
            self._domain = knowledge(task.domain, task.source, task.ties)
            self._goal = tuple(task.goal)
            self._limits = limits_of(task)
            self._reasoner: Reasoner[H_contra] | None = None
            self._explanation = Explanation()
            self._told: tuple[Explanation, tuple[Happening, ...]] = (Explanation(), ())
            known: State = frozenset(each for each in task.initial if each.is_positive)
            self._believed = (0, known)
            self._begin(task)
        self._prepared = reasoning_clock().since(began).preparation_cpu

    def act(self, percept: Percept) -> Decision:
        """One turn; where it reaches a limit of decisions, the robot waits a step.

        Raises RobotStops where nothing explains the history.
        """
        with deciding() as decision:
            thought = Thought(self._explanation)
            try:
                with deciding(self._limits):
                    self._observe(percept)
                    self._think(thought)
            except LimitError as limit:
                thought.ended, thought.limit = reasoning_clock(), str(limit)
            except InconsistentHistoryError as error:
                raise RobotStops(str(error)) from error
            trace = thought.timed(self._trace(thought), self._prepared)
        self._prepared = 0.0
        intention, action = thought.intention, WAIT
        if intention is not None:
            self._attempt(intention)
            action = WAIT if is_mental(intention.action) else intention.action
        return Decision(
            trial=percept.trial,
            step=percept.step,
            action=action,
            believes_goal=intention is not None and GOAL in intention.believed,
            trace=structs.replace(trace, minimal=thought.minimal, deadline=decision.late),
        )

    def snapshot(self) -> Self:
        """A twin that stays as this robot is now: what is shared with it never changes."""
        twin = copy(self)
        for name in _GROWING:
            value = getattr(self, name, None)
            setattr(twin, name, None if value is None else value.copy())
        return twin

    def restore(self, snapshot: Self) -> None:
        """Becomes as the robot was whose snapshot this is, which may be used again."""
        self.__dict__ = vars(snapshot.snapshot())

    @abstractmethod
    def _begin(self, task: Task) -> None:
        """Begins the history, and what else the robot keeps of a trial."""

    @abstractmethod
    def _hear(self, percept: Percept) -> None:
        """Adds to the history the result of the last attempt."""

    def _relevant(self, percept: Percept) -> Iterable[Literal]:
        """The visible literals that enter the history (P 3.2). Raises LimitError."""
        return self._outcome(percept)

    def _outcome(self, percept: Percept) -> list[Literal]:
        """The outcome of the last attempt, which is relevant whatever else is.

        An action's `shows` statements say what that is, those whose condition is seen.
        """
        seen = frozenset(percept.visible)
        shown = {
            statement.fluent
            for statement in self._domain.description.shows
            if statement.action == percept.attempted and seen.issuperset(statement.body)
        }
        return [literal for literal in percept.visible if literal.atom in shown]

    @abstractmethod
    def _trace(self, thought: Thought) -> Trace:
        """The mind behind the decision, before anything of it is recorded."""

    @abstractmethod
    def _attempt(self, intention: Intention) -> None:
        """Records what is attempted."""

    def _observe(self, percept: Percept) -> None:
        """Adds to the history the result of the last attempt, news, and what is observed.

        Raises LimitError, after which nothing is observed beside the outcome of the attempt.
        """
        history = self._history
        self._hear(percept)
        for event in percept.events:
            history.happened(event.action, True, event.step)
        history.step = percept.step
        observed: Iterable[Literal] = self._outcome(percept)
        try:
            observed = self._relevant(percept)
        finally:
            history.observe(observed, percept.step)
            history.doubt(percept.doubtful, percept.step)

    def _prepare(self) -> Reasoner[H_contra]:
        """What the domain is reasoned with, made in a decision so that its limits hold for it."""
        limit, plans = self._task.plan_limit, self._task.plans
        with preparation():
            self._reasons = self._reasons_type(self._domain, self._task)
            self._expectations = (
                None if self._domain.deterministic else Expectations(self._domain, self._goal)
            )
            self._reasoner = self._make_reasoner(self._domain, self._goal, limit, plans)
        return self._reasoner

    def _think(self, thought: Thought) -> None:
        """Both phases. Raises LimitError, after which what was found so far is kept."""
        reasoner = self._reasoner or self._prepare()
        diagnosis = self._diagnosed(reasoner)
        thought.diagnosed = reasoning_clock()
        thought.diagnosis, self._explanation = diagnosis, diagnosis.explanation
        self._compare(thought)
        intention = self._intend(reasoner, thought)
        thought.ended, thought.intention = reasoning_clock(), intention

    def _compare(self, thought: Thought) -> None:
        """Whether an action had another outcome than expected, by the latest observations."""
        expectations, history = self._expectations, self._history
        if expectations is None:
            return
        before = thought.before.left(history)
        is_contradicted = expectations.follow(history, before)
        thought.expected = dict(expectations.states)
        if self._explanation != before:
            expectations.forget()
        elif is_contradicted:
            thought.outcome = expectations.other_outcome(history, before)

    def _expect(self, believed: State, ahead: tuple[Action, ...]) -> None:
        """A decision was made in a state that is believed in, with a plan ahead."""
        if self._expectations is not None:
            self._expectations.believe(self._history.step, believed, ahead)

    def _intend(self, reasoner: Reasoner[H_contra], thought: Thought) -> Intention:
        """Phase two."""
        assert thought.diagnosis is not None
        return reasoner.intend(self._history, thought.diagnosis)

    def _diagnosed(self, reasoner: Reasoner[H_contra]) -> Diagnosis:
        """Phase one; where no events explain the history, tests were wrong."""
        try:
            return reasoner.diagnose(self._history, self._explanation)
        except InconsistentHistoryError:
            if not distrust_tests(self._domain, self._goal, self._history):
                raise
            return reasoner.diagnose(self._history, self._explanation)

    def _with_explanation(self, trace: Trace, thought: Thought) -> Trace:
        """The trace with the explanation, and what made it needed, if it has not been told yet."""
        told, (before, _) = (self._explanation, self._history.misread), self._told
        if told == self._told and thought.outcome is None:
            return trace
        self._told = told
        history, (since, believed) = self._history, self._believed
        contradictions = self._reasons.contradictions(
            history, before, believed, since, thought.expected
        )
        explanation = self._reasons.explanation(*told, thought.outcome, history.step)
        return structs.replace(trace, explanation=explanation, contradictions=contradictions)
