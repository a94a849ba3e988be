"""Histories and their explanations as literals of a session of the solver."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass

import clingo
from clingo import Symbol

from asp.language import Literal
from asp.reasoning.diagnosis.history import Explanation, Happening, History, Record, record_of
from asp.reasoning.knowledge import Knowledge
from asp.solving import Session, State, fact, literal_of


@dataclass(frozen=True)
class Problem:
    """What there is to explain: the records up to `step`, with a goal that some of them tell of.

    `since` is the first step at which an event may have occurred.
    """

    goal: tuple[Literal, ...]
    records: Mapping[int, Record]
    step: int
    since: int

    def suffix(self, first: int) -> Problem:
        """The end of this history, from a step on that becomes step 0."""
        every = self.records.items()
        records = {step - first: record for step, record in every if first <= step <= self.step}
        return Problem(self.goal, records, self.step - first, max(0, self.since - first))

    @property
    def externals(self) -> list[Symbol]:
        """past(I), reported(E,I), attempted(A,I) and failing(I)."""
        atoms = [fact("past", time) for time in range(self.since, self.step)]
        for time, record in self.records.items():
            if time < self.step:
                atoms += (fact("reported", event, time) for event in record.reported)
                if record.action is not None:
                    atoms.append(fact("attempted", record.action, time))
                if record.failing:
                    atoms.append(fact("failing", time))
        return atoms


def problem_of(
    knowledge: Knowledge, goal: tuple[Literal, ...], history: History, since: int
) -> Problem:
    """All that there is to explain of a history."""
    records = {
        step: record_of(moment, *knowledge.actions) for step, moment in history.moments.items()
    }
    return Problem(goal, records, history.step, since)


@dataclass(frozen=True)
class Interpretation:
    """An explanation, the initial state, the state at the last step, when the goal held."""

    explanation: Explanation
    initial: State
    state: State
    held: frozenset[int]


def observations(session: Session, problem: Problem) -> list[int] | None:
    """Assumptions for everything observed; None where an atom that must be true cannot be."""
    wanted: list[tuple[int | None, bool]] = []
    for time, record in problem.records.items():
        if time > problem.step:
            continue
        wanted += (
            (session.holds(literal.atom, time), literal.is_positive) for literal in record.observed
        )
        if record.goal is not None:
            wanted.append((session.literal("reached", time), record.goal))
        if record.attempt is not None and time < problem.step:
            action, happened = record.attempt
            wanted.append((session.literal("occurs", action, time), happened))
    return assumptions(wanted)


def assumptions(wanted: Iterable[tuple[int | None, bool]]) -> list[int] | None:
    """Truth values of solver literals as assumptions; None where one cannot be true."""
    known = list(wanted)
    if any(literal is None and truth for literal, truth in known):
        return None
    return [lit if truth else -lit for lit, truth in known if lit is not None]


def interpretation(session: Session, model: clingo.Model, problem: Problem) -> Interpretation:
    """What a model says of a problem."""
    held = (
        time for time in range(problem.step + 1) if is_true(model, session.literal("reached", time))
    )
    return Interpretation(
        explanation_of(model.symbols(shown=True)),
        session.state(model, 0),
        session.state(model, problem.step),
        frozenset(held),
    )


def explanation_of(shown: Iterable[Symbol], proved: bool = True) -> Explanation:
    """The explanation that the shown atoms of an answer set are."""
    found: dict[str, list[list[Symbol]]] = {}
    for symbol in shown:
        found.setdefault(symbol.name, []).append(symbol.arguments)
    unobserved, distrusted = (
        tuple(sorted(Happening(step.number, literal_of(a)) for a, step in found.get(name, [])))
        for name in ("unobserved", "distrusted")
    )
    initial = (
        Literal.of(fluent.name, map(str, fluent.arguments), truth.name == "true")
        for fluent, truth in found.get("initial", [])
    )
    return Explanation(
        unobserved,
        distrusted,
        tuple(sorted(str(default) for (default,) in found.get("exception", []))),
        tuple(sorted(initial)),
        proved,
    )


def is_true(model: clingo.Model, literal: int | None) -> bool:
    """Whether a literal is true in a model; None is no literal of any model."""
    return literal is not None and model.is_true(literal)
