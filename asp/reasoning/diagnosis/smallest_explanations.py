"""Smallest explanations of a history: exceptions to defaults, events that nobody reported."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from itertools import product

from asp.reasoning.diagnosis.explanations import Alternatives, Explanation, explanation_of
from asp.reasoning.diagnosis.history import Problem
from asp.reasoning.knowledge import Knowledge
from asp.solving import (
    Recent,
    Session,
    State,
    answer_sets,
    assumptions,
    goal_externals,
    is_satisfiable,
    preferring,
    state_of,
    theory,
)

FEW, MANY = 4, 16
"""How many events and distrusted reports are counted: most explanations are of a few."""

_FIRST_HORIZON = 16
_MOST_SESSIONS = 4


@dataclass(frozen=True)
class Interpretation:
    """An explanation of a history, and the states of all steps."""

    explanation: Explanation
    states: Sequence[State]


@dataclass(frozen=True)
class Question:
    """A session switched to a problem, which counts events and distrusted reports up to `most`.

    `given` are assumptions for everything observed; None where that cannot be.
    """

    session: Session
    most: int
    problem: Problem
    given: list[int] | None

    @property
    def possible(self) -> bool:
        """Whether any explanation has at most as many events as are counted."""
        if self.most == FEW:
            return self.given is not None  # found out while they are counted
        return self.given is not None and is_satisfiable(self.session.control, self.given)

    def assuming(self, more: Sequence[int] | None) -> Question:
        """The question with more assumptions; None: with some that cannot be."""
        given = None if self.given is None or more is None else [*self.given, *more]
        return replace(self, given=given)

    def starting(self, state: State) -> Question:
        """The question where this was the state at first."""
        return self.assuming(self.session.assume_state(state, 0))

    def first(self, events: int, exceptions: int | None = None) -> Interpretation | None:
        """The preferred explanation with at most so many events and exactly so many exceptions."""
        limited = self._at_most(events, exceptions)
        if limited is None:
            return None
        session, step = self.session, self.problem.step
        with preferring(session.control, limited) as model:
            if model is None:
                return None
            states = [session.state(model, time) for time in range(step + 1)]
            return Interpretation(explanation_of(model.symbols(shown=True)), states)

    def all(
        self, events: int, exceptions: int | None, most: int
    ) -> tuple[list[tuple[Explanation, State]], bool]:
        """At most so many of these explanations, and whether there are more; True: cannot tell.

        Each has the state that it leads to, where the question is one of outcomes.
        """
        limited = self._at_most(events, exceptions)
        if limited is None:
            return [], True
        found, more = answer_sets(self.session.control, limited, most)
        return [(explanation_of(shown), state_of(shown)) for shown in found], more

    def _at_most(self, events: int, exceptions: int | None) -> list[int] | None:
        """Assumptions for at most so many events, exactly so many exceptions; None: impossible."""
        if self.given is None or events > self.most:
            return None
        limited = list(self.given)
        if events < self.most:
            more = self.session.literal("count", self.problem.step, events + 1)
            limited += [] if more is None else [-more]
        if exceptions is not None:
            number = self.session.literal("number_exceptions", exceptions)
            if number is None:
                return None
            limited.append(number)
        return limited


class SmallestExplanations:
    """The smallest explanations in one domain; the horizon doubles where a history outgrows it.

    A session counts events up to a number; one that counts further is grounded when a small one
    does not suffice.
    """

    def __init__(self, knowledge: Knowledge, begins: bool = True) -> None:
        """`begins` says that histories begin with an initial state, of which there are defaults."""
        theories = ("defaults", "order") if begins else ("order",)
        self._program = "\n".join([knowledge.program, *map(theory, theories)])
        self._facts = (*knowledge.ranks, *(knowledge.start if begins else ()))
        self._description = knowledge.description
        self._sessions: Recent[tuple[object, ...], Session] = Recent(_MOST_SESSIONS)

    def smallest(self, problem: Problem, fewest: tuple[int, int] = (0, 0)) -> Interpretation | None:
        """The first of the smallest explanations, with what follows from it.

        None has fewer events and distrusted reports than the first number of `fewest`, or as many
        and fewer exceptions than the second. None stands for "more events than are counted, or no
        explanation at all", which is left to the reference.
        """
        tried, defaults = fewest[0], self._description.defaults
        for most in (FEW, MANY):
            question = self.question(problem, most)
            if question.possible and tried <= most:
                sizes = product(range(tried, most + 1), range(len(defaults) + 1))
                every = (question.first(*size) for size in sizes if size >= fewest)
                if (found := next(filter(None, every), None)) is not None:
                    return found
            tried = max(tried, most + 1)
        return None

    def keeping(self, problem: Problem, adopted: Explanation) -> Interpretation | None:
        """The first interpretation with exactly these events, reports and exceptions.

        None where there is none, or there are too many of them.
        """
        question = self.question(problem, FEW if adopted.size <= FEW else MANY)
        literal = question.session.literal
        exactly = [literal("unobserved", event, step) for step, event in adopted.unobserved]
        exactly += [literal("distrusted", action, step) for step, action in adopted.distrusted]
        exactly += [literal("exception", default) for default in adopted.exceptions]
        question = question.assuming(assumptions((each, True) for each in exactly))
        return question.first(adopted.size, len(adopted.exceptions))

    def alternatives(self, problem: Problem, adopted: Explanation, most: int) -> Alternatives:
        """Explanations with as many events and distrusted reports, and exceptions, as one.

        With them, whether there are more than `most`; True also where the session cannot tell. If
        the one is smallest, these are all smallest explanations.
        """
        question = self.question(problem, FEW if adopted.size <= FEW else MANY)
        found, more = question.all(adopted.size, len(adopted.exceptions), most)
        return [explanation for explanation, _ in found], more

    def question(self, problem: Problem, most: int) -> Question:
        """The session that counts so far, with the problem's externals and observations."""
        # It depends on the history alone, so that budgets do not depend on earlier histories.
        horizon = _FIRST_HORIZON
        while horizon < problem.step:
            horizon *= 2
        return self._question(problem, most, horizon)

    def outcomes(self, problem: Problem, most: int) -> Question:
        """The explanations of a history of a step or none, each with the states it may lead to.

        So many events and distrusted reports are counted at most.
        """
        return self._question(problem, most, problem.step, "outcomes")

    def _question(self, problem: Problem, most: int, horizon: int, *parts: str) -> Question:
        def made() -> Session:
            fluents, constants = self._description.fluents, {"n": horizon, "most": most}
            name = "incremental_diagnosis"
            return Session(self._program, name, fluents, self._facts, parts, **constants)

        session = self._sessions.get((horizon, most, *parts), made)
        session.switch_on(*goal_externals(problem.goal), *problem.externals)
        return Question(session, most, problem, assumptions(_observations(session, problem)))


def _observations(session: Session, problem: Problem) -> Iterator[tuple[int | None, bool]]:
    """Everything observed, as literals of the solver with their truth."""
    for time, record in problem.records.items():
        for literal in record.observed:
            yield session.holds(literal.atom, time), literal.is_positive
        if record.goal is not None:
            yield session.literal("reached", time), record.goal
        if record.attempt is not None and time < problem.step:
            action, happened = record.attempt
            yield session.literal("occurs", action, time), happened
