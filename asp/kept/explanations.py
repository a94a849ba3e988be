"""Smallest explanations of a history: exceptions to defaults, events that nobody reported."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass

import clingo
from clingo import Symbol

from asp.kept.control import KeptControl, State, goal_externals
from asp.literals import atom, is_positive
from asp.preferring import preferring
from asp.solving import answer_sets, fact, theory

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
class Past:
    """What there is to explain: the records up to `step`, with a goal that some of them tell of.

    `since` is the first step at which an event may have occurred.
    """

    goal: tuple[str, ...]
    records: Mapping[int, Record]
    step: int
    since: int


@dataclass(frozen=True)
class Assumed:
    """An explanation: unobserved events, reports of what did not happen, defaults by name."""

    events: tuple[tuple[int, str], ...] = ()
    distrusted: tuple[tuple[int, str], ...] = ()
    exceptions: tuple[str, ...] = ()


@dataclass(frozen=True)
class Account:
    """An explanation, the initial state, the state at the last step, when the goal held."""

    assumed: Assumed
    initial: State
    state: State
    held: frozenset[int]


class Explanations:
    """The smallest explanations in one domain; the horizon doubles when a history outgrows it."""

    def __init__(
        self,
        program: str,
        fluents: Sequence[str],
        events: Sequence[str],
        defaults: Sequence[str],
        ranks: Iterable[Symbol],
    ) -> None:
        """`ranks` are the facts that `order.lp` and `defaults.lp` are given from outside."""
        self._program = "\n".join([program, theory("defaults"), theory("order")])
        self._fluents = fluents
        self._events = events
        self._defaults = defaults
        self._ranks = tuple(ranks)
        self._kept: KeptControl | None = None
        self._horizon = _FIRST_HORIZON

    def smallest(self, past: Past, fewest: tuple[int, int] = (0, 0)) -> Account | None:
        """The first of the smallest explanations of the past.

        None has fewer events and distrusted reports than the first number of `fewest`, or as many
        and fewer exceptions than the second. None stands for "more than a handful of events",
        which is left to the theory itself.
        """
        kept, given = self._given(past)
        for events in range(fewest[0], _MOST + 1):
            least = fewest[1] if events == fewest[0] else 0
            for exceptions in range(least, len(self._defaults) + 1):
                account = self._first(kept, given, past, events, exceptions)
                if account is not None:
                    return account
        return None

    def keeping(self, past: Past, assumed: Assumed) -> Account | None:
        """The first account with exactly this explanation; None: there is none, or it is long."""
        kept, given = self._given(past)
        events = [kept.literal("unobserved", name, step) for step, name in assumed.events]
        events += [kept.literal("distrusted", name, step) for step, name in assumed.distrusted]
        exceptions = [kept.literal("exception", name) for name in assumed.exceptions]
        exactly = _assumptions((literal, True) for literal in (*events, *exceptions))
        if given is None or exactly is None or len(events) > _MOST:
            return None
        return self._first(kept, given + exactly, past, len(events), len(exceptions))

    def alternatives(
        self, past: Past, size: tuple[int, int], most: int
    ) -> tuple[list[Assumed], bool]:
        """Explanations of the past with so many events and distrusted reports, and exceptions.

        With them, whether there are more than `most`; True also where the control cannot tell. If
        `size` is the smallest, these are all smallest explanations.
        """
        kept, given = self._given(past)
        assumptions = self._at_most(kept, given, past, *size)
        if assumptions is None or size[0] > _MOST:
            return [], True
        found, more = answer_sets(kept.control, assumptions, most)
        return [_assumed(shown) for shown in found], more

    def _given(self, past: Past) -> tuple[KeptControl, list[int] | None]:
        """The control with the past's externals, and assumptions for everything observed."""
        kept = self._reaching(past.step)
        kept.switch_on(*goal_externals(past.goal), *_externals(past))
        return kept, self._assume(kept, past)

    def _first(
        self,
        kept: KeptControl,
        given: list[int] | None,
        past: Past,
        events: int,
        exceptions: int,
    ) -> Account | None:
        """The preferred explanation with at most so many events and exactly so many exceptions."""
        assumptions = self._at_most(kept, given, past, events, exceptions)
        if assumptions is None:
            return None
        with preferring(kept.control, assumptions) as model:
            return None if model is None else self._read(kept, model, past.step)

    def _at_most(
        self,
        kept: KeptControl,
        given: list[int] | None,
        past: Past,
        events: int,
        exceptions: int,
    ) -> list[int] | None:
        more = kept.literal("count", past.step, events + 1) if events < _MOST else None
        number = kept.literal("number_exceptions", exceptions)
        if given is None or number is None:
            return None
        return [*given, number] if more is None else [*given, number, -more]

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

    def _assume(self, kept: KeptControl, past: Past) -> list[int] | None:
        """Assumptions for everything observed; None where an atom that must be true cannot be."""
        wanted: list[tuple[int | None, bool]] = []
        for time, record in past.records.items():
            if time > past.step:
                continue
            wanted += (
                (kept.holds(atom(literal), time), is_positive(literal))
                for literal in record.observed
            )
            if record.goal is not None:
                wanted.append((kept.literal("reached", time), record.goal))
            if record.attempt is not None and time < past.step:
                action, happened = record.attempt
                wanted.append((kept.literal("occurs", action, time), happened))
        return _assumptions(wanted)

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
        exceptions = tuple(
            name for name in self._defaults if _true(model, kept.literal("exception", name))
        )
        held = frozenset(
            time for time in range(step + 1) if _true(model, kept.literal("reached", time))
        )
        assumed = Assumed(unobserved, distrusted, exceptions)
        return Account(assumed, kept.state(model, 0), kept.state(model, step), held)


def _assumed(shown: Iterable[Symbol]) -> Assumed:
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


def _externals(past: Past) -> list[Symbol]:
    atoms = [fact("past", time) for time in range(past.since, past.step)]
    for time, record in past.records.items():
        if time < past.step:
            atoms += (fact("reported", event, time) for event in record.reported)
            if record.attempt is not None:
                atoms.append(fact("attempted", record.attempt[0], time))
    return atoms


def _assumptions(wanted: Iterable[tuple[int | None, bool]]) -> list[int] | None:
    """Truth values of solver literals as assumptions; None where one cannot be true."""
    known = list(wanted)
    if any(literal is None and truth for literal, truth in known):
        return None
    return [lit if truth else -lit for lit, truth in known if lit is not None]


def _true(model: clingo.Model, literal: int | None) -> bool:
    return literal is not None and model.is_true(literal)
