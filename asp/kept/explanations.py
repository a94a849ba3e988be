"""Smallest explanations of a history by exogenous actions that nobody reported."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass

import clingo
from clingo import Symbol

from asp.kept.control import KeptControl, State, goal_externals
from asp.literals import atom, is_positive
from asp.solving import fact, solving

_FIRST_HORIZON = 16
_MOST = 4


@dataclass(frozen=True)
class Record:
    """What one step of a history says.

    `observed` are literals, `attempt` the agent's physical action with whether it took effect,
    `reported` the exogenous actions that happened, `goal` whether the goal was seen to hold.
    """

    observed: tuple[str, ...] = ()
    attempt: tuple[str, bool] | None = None
    reported: tuple[str, ...] = ()
    goal: bool | None = None


@dataclass(frozen=True)
class Account:
    """An explanation, the state it leads to, and the steps at which the goal held.

    `events` are unobserved, `distrusted` reports of what did not happen.
    """

    events: tuple[tuple[int, str], ...]
    distrusted: tuple[tuple[int, str], ...]
    state: State
    held: frozenset[int]


class Explanations:
    """The smallest explanations in one domain; the horizon doubles when a history outgrows it."""

    def __init__(
        self,
        program: str,
        fluents: Sequence[str],
        events: Sequence[str],
        ranks: Iterable[Symbol],
    ) -> None:
        self._program = program
        self._fluents = fluents
        self._events = events
        self._ranks = tuple(ranks)
        self._kept: KeptControl | None = None
        self._horizon = _FIRST_HORIZON

    def smallest(
        self,
        initial: State,
        goal: tuple[str, ...],
        records: Mapping[int, Record],
        step: int,
        fewest: int,
        since: int,
    ) -> Account | None:
        """The first of the smallest explanations of the records up to `step`.

        `fewest` is a number of events below which there is none, `since` the first step at which
        one may have occurred. None stands for "more than a
        handful of events", which is left to the theory itself.
        """
        kept = self._reaching(step)
        kept.switch_on(*goal_externals(goal), *_externals(records, since, step))
        given = self._assume(kept, initial, records, step)
        if given is None:
            return None
        for number in range(fewest, _MOST + 1):
            more = kept.literal("count", step, number + 1) if number < _MOST else None
            assumptions = given if more is None else [*given, -more]
            with solving(kept.control, assumptions) as model:
                if model is not None:
                    return self._read(kept, model, step)
        return None

    def _reaching(self, step: int) -> KeptControl:
        while self._horizon < step:
            self._horizon *= 2
            self._kept = None
        if self._kept is None:
            self._kept = KeptControl(
                self._program,
                "kept_diagnosis",
                self._fluents,
                self._ranks,
                n=self._horizon,
                most=_MOST,
            )
        return self._kept

    def _assume(
        self, kept: KeptControl, initial: State, records: Mapping[int, Record], step: int
    ) -> list[int] | None:
        """Assumptions for everything observed; None where an atom that must be true cannot be."""
        start = kept.assume_state(initial, 0)
        wanted: list[tuple[int | None, bool]] = []
        for time, record in records.items():
            if time > step:
                continue
            wanted += (
                (kept.holds(atom(literal), time), is_positive(literal))
                for literal in record.observed
            )
            if record.goal is not None:
                wanted.append((kept.literal("reached", time), record.goal))
            if record.attempt is not None and time < step:
                action, happened = record.attempt
                wanted.append((kept.literal("occurs", action, time), happened))
        if start is None or any(lit is None and truth for lit, truth in wanted):
            return None
        return start + [lit if truth else -lit for lit, truth in wanted if lit is not None]

    def _read(self, kept: KeptControl, model: clingo.Model, step: int) -> Account:
        unobserved, distrusted = (
            tuple(
                (time, event)
                for time in range(step)
                for event in self._events
                if _true(model, kept.literal(predicate, event, time))
            )
            for predicate in ("unobserved", "distrusted")
        )
        held = frozenset(
            time for time in range(step + 1) if _true(model, kept.literal("reached", time))
        )
        return Account(unobserved, distrusted, kept.state(model, step), held)


def _externals(records: Mapping[int, Record], since: int, step: int) -> list[Symbol]:
    atoms = [fact("past", time) for time in range(since, step)]
    for time, record in records.items():
        if time < step:
            atoms += (fact("reported", event, time) for event in record.reported)
            if record.attempt is not None:
                atoms.append(fact("attempted", record.attempt[0], time))
    return atoms


def _true(model: clingo.Model, literal: int | None) -> bool:
    return literal is not None and model.is_true(literal)
