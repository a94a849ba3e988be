"""What there is to explain, what explains it, and both as literals of a kept control."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass

import clingo
from clingo import Symbol

from asp.language import atom, is_positive
from asp.solving import Session, State, fact

Happening = tuple[int, str]
"""An exogenous action at a step."""


@dataclass(frozen=True)
class Record:
    """What one step of a history says.

    `observed` are literals, `attempt` the agent's physical action with whether it took effect,
    `failing` if its execution failed though it may have been possible, `reported` the exogenous
    actions that happened, `goal` whether the goal was seen to hold.
    """

    observed: tuple[str, ...] = ()
    attempt: tuple[str, bool] | None = None
    reported: tuple[str, ...] = ()
    goal: bool | None = None
    failing: bool = False

    @property
    def distrustable(self) -> tuple[str, ...]:
        """What may be distrusted of the step: reports, and an attempt that failed."""
        failed = (self.attempt[0],) if self.attempt is not None and self.failing else ()
        return (*self.reported, *failed)


@dataclass(frozen=True)
class Past:
    """What there is to explain: the records up to `step`, with a goal that some of them tell of.

    `since` is the first step at which an event may have occurred.
    """

    goal: tuple[str, ...]
    records: Mapping[int, Record]
    step: int
    since: int

    def from_step(self, first: int) -> Past:
        """The end of this past, from a step on that becomes step 0."""
        records = {
            step - first: self.records[step]
            for step in range(first, self.step + 1)
            if step in self.records
        }
        return Past(self.goal, records, self.step - first, max(0, self.since - first))


@dataclass(frozen=True)
class Assumed:
    """An explanation: unobserved events, false reports and attempts, defaults by name."""

    events: tuple[Happening, ...] = ()
    distrusted: tuple[Happening, ...] = ()
    exceptions: tuple[str, ...] = ()

    @property
    def size(self) -> int:
        """How many events, and false reports and attempts, it assumes (27)."""
        return len(self.events) + len(self.distrusted)


@dataclass(frozen=True)
class Account:
    """An explanation, the initial state, the state at the last step, when the goal held."""

    assumed: Assumed
    initial: State
    state: State
    held: frozenset[int]


def externals(past: Past) -> list[Symbol]:
    """past(I), reported(E,I), attempted(A,I) and failing(I) of a past."""
    atoms = [fact("past", time) for time in range(past.since, past.step)]
    for time, record in past.records.items():
        if time < past.step:
            atoms += (fact("reported", event, time) for event in record.reported)
            if record.attempt is not None:
                atoms.append(fact("attempted", record.attempt[0], time))
            if record.failing:
                atoms.append(fact("failing", time))
    return atoms


def distrustable(past: Past) -> Iterator[Happening]:
    """What may be distrusted of a past, step by step."""
    for time in range(past.step):
        record = past.records.get(time, Record())
        yield from ((time, action) for action in record.distrustable)


def observations(kept: Session, past: Past) -> list[int] | None:
    """Assumptions for everything observed; None where an atom that must be true cannot be."""
    wanted: list[tuple[int | None, bool]] = []
    for time, record in past.records.items():
        if time > past.step:
            continue
        wanted += (
            (kept.holds(atom(literal), time), is_positive(literal)) for literal in record.observed
        )
        if record.goal is not None:
            wanted.append((kept.literal("reached", time), record.goal))
        if record.attempt is not None and time < past.step:
            action, happened = record.attempt
            wanted.append((kept.literal("occurs", action, time), happened))
    return assumptions(wanted)


def assumptions(wanted: Iterable[tuple[int | None, bool]]) -> list[int] | None:
    """Truth values of solver literals as assumptions; None where one cannot be true."""
    known = list(wanted)
    if any(literal is None and truth for literal, truth in known):
        return None
    return [lit if truth else -lit for lit, truth in known if lit is not None]


def account(
    kept: Session,
    model: clingo.Model,
    past: Past,
    events: Sequence[str],
    defaults: Sequence[str],
) -> Account:
    """What a model says of a past; `events` are the exogenous actions, `defaults` names."""
    step = past.step
    unobserved = tuple(
        (time, event)
        for time in range(step)
        for event in events
        if is_true(model, kept.literal("unobserved", event, time))
    )
    distrusted = tuple(
        (time, action)
        for time, action in distrustable(past)
        if is_true(model, kept.literal("distrusted", action, time))
    )
    exceptions = tuple(name for name in defaults if is_true(model, kept.literal("exception", name)))
    held = frozenset(
        time for time in range(step + 1) if is_true(model, kept.literal("reached", time))
    )
    assumed = Assumed(unobserved, distrusted, exceptions)
    return Account(assumed, kept.state(model, 0), kept.state(model, step), held)


def assumed(shown: Iterable[Symbol]) -> Assumed:
    """The explanation that the shown atoms of an answer set are."""
    found: dict[str, list[list[Symbol]]] = {}
    for symbol in shown:
        found.setdefault(symbol.name, []).append(symbol.arguments)
    unobserved, distrusted = (
        tuple(sorted((step.number, str(event)) for event, step in found.get(name, [])))
        for name in ("unobserved", "distrusted")
    )
    exceptions = sorted(str(default) for (default,) in found.get("exception", []))
    return Assumed(unobserved, distrusted, tuple(exceptions))


def is_true(model: clingo.Model, literal: int | None) -> bool:
    """Whether a literal is true in a model; None is no literal of any model."""
    return literal is not None and model.is_true(literal)
