"""Smallest explanations of a history of which only the end is explained, from a frontier on."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property
from itertools import groupby

import clingo
from clingo import Symbol

from asp.reasoning.diagnosis.encoding import (
    Interpretation,
    Problem,
    explanation_of,
    interpretation,
    is_true,
    observations,
)
from asp.reasoning.diagnosis.history import Explanation
from asp.reasoning.diagnosis.long_histories.prefixes import Frontier, PrefixExplanation
from asp.reasoning.knowledge import Knowledge
from asp.solving import (
    Session,
    State,
    answer_sets,
    fact,
    goal_externals,
    preferring,
    theory,
    undisturbed,
)

LENGTH = 24
"""How many steps the end of a history may have."""

MOST_ENTRIES = 64
"""How many states a frontier may have."""

MOST_MORE = 4
"""How many events and distrusted reports a session counts, beyond those of the cheapest entry."""


class SuffixExplanations:
    """What explains the end of a history in one domain, and with it the whole."""

    def __init__(self, knowledge: Knowledge) -> None:
        self._knowledge = knowledge
        self._on: set[int] = set()

    def smallest(self, frontier: Frontier, problem: Problem, fewest: int) -> Interpretation | None:
        """The first of the smallest explanations of a history, not smaller than `fewest`.

        Its initial state and exceptions are left open. None where the frontier does not know all
        of those that are as small.
        """
        question = self._question(frontier, problem)
        if question is None:
            return None
        for size in range(max(fewest, frontier.least), question.most + 1):
            found = self._first(question, size)
            if found is not None:
                return found
        return None

    def alternatives(
        self, frontier: Frontier, problem: Problem, size: int, most: int
    ) -> tuple[list[Explanation], bool] | None:
        """At most so many explanations of the smallest size, and whether there are more of them.

        None where the frontier does not know.
        """
        question = self._question(frontier, problem)
        if question is None or not frontier.least <= size <= question.most:
            return None
        shown, more = answer_sets(question.session.control, question.at_most(size), most)
        found: list[Explanation] = []
        for answer in shown:
            (entry,) = (s.arguments[0].number for s in answer if s.name == "from")
            prefixes, left_off = frontier.told(question.entries[entry - 1][1])
            suffix = explanation_of(answer)
            found += (prefix.followed_by(suffix, frontier.step) for prefix in prefixes)
            more = more or left_off
        return found[:most], more or len(found) > most

    def _first(self, question: _Question, size: int) -> Interpretation | None:
        """The first explanation with at most so many events and distrusted reports."""
        control, limited = question.session.control, question.at_most(size)
        with preferring(control, limited) as model:
            if model is None:
                return None
            if len(question.alike) == 1:
                return self._read(question, model)
            limited = [*limited, *question.trust(model)]
        # Which reports are distrusted before the end comes before which events are assumed in it.
        for entries in question.alike:
            self._offer(question, entries)
            with preferring(control, limited) as model:
                if model is not None:
                    return self._read(question, model)
        raise AssertionError("some entry led to the first model")

    def _question(self, frontier: Frontier, problem: Problem) -> _Question | None:
        """The session with the end of a history and the entries of a frontier; None: too many."""
        suffix = problem.suffix(frontier.step)
        most = min(frontier.limit, frontier.least + MOST_MORE)
        known = [
            (state, prefixes)
            for state, prefixes in frontier.entries.items()
            if prefixes[0].size <= most
        ]
        if not known or len(known) > MOST_ENTRIES or suffix.step > LENGTH:
            return None
        session = self._session
        session.switch_on(*goal_externals(problem.goal), *suffix.externals)
        given = observations(session, suffix)
        if given is None:
            return None
        entries = sorted(known, key=lambda entry: entry[1][0].order)
        inertial = self._knowledge.description.inertial
        question = _Question(session, frontier, suffix, most, entries, given, inertial)
        self._offer(question, range(1, len(entries) + 1))
        return question

    def _offer(self, question: _Question, entries: Iterable[int]) -> None:
        """Makes exactly these entries available."""
        on = question.offering(entries)
        with undisturbed():
            for literal in self._on ^ on:
                question.session.control.assign_external(literal, literal in on)
            self._on = on

    def _read(self, question: _Question, model: clingo.Model) -> Interpretation:
        """The interpretation of the whole history, but for how it began and its exceptions."""
        session, first = question.session, question.frontier.step
        end = interpretation(session, model, question.suffix, self._knowledge, ())
        prefix = next(
            prefixes[0]
            for number, (_, prefixes) in enumerate(question.entries, start=1)
            if is_true(model, session.literal("from", number))
        )
        held = frozenset(first + step for step in end.held).union(prefix.steps_held)
        whole = prefix.followed_by(end.explanation, first)
        return Interpretation(whole, frozenset(), end.state, held)

    @cached_property
    def _session(self) -> Session:
        known = self._knowledge
        return Session(
            "\n".join([known.program, theory("order")]),
            "incremental_diagnosis",
            known.description.fluents,
            map(_with_room, known.ranks),
            ["suffix"],
            n=LENGTH,
            most=MOST_MORE,
            entries=MOST_ENTRIES,
        )


@dataclass(frozen=True)
class _Question:
    """A session switched to the end of a history, and what the frontier's entries lead to.

    `entries` are in the order of their explanations, numbered from 1; `most` is the size up to
    which they are complete. `given` are assumptions for all that was observed.
    """

    session: Session
    frontier: Frontier
    suffix: Problem
    most: int
    entries: Sequence[tuple[State, Sequence[PrefixExplanation]]]
    given: list[int]
    inertial: Sequence[str]

    def at_most(self, size: int) -> list[int]:
        """Assumptions for at most so many events and distrusted reports in the whole history."""
        room = size - self.frontier.least
        more = (
            self.session.literal("count", self.suffix.step, room + 1) if room < MOST_MORE else None
        )
        return self.given if more is None else [*self.given, -more]

    def offering(self, entries: Iterable[int]) -> set[int]:
        """The externals that make these entries available, with their states and prices."""
        session, wanted = self.session, set[int | None]()
        for entry in entries:
            state, prefixes = self.entries[entry - 1]
            wanted.add(session.literal("available", entry))
            wanted |= {session.literal("has", entry, f) for f in self.inertial if f in state}
            dearer = prefixes[0].size - self.frontier.least
            wanted |= {session.literal("price", entry, number) for number in range(1, dearer + 1)}
        return {literal for literal in wanted if literal is not None}

    @property
    def alike(self) -> list[list[int]]:
        """The numbers of the entries, grouped by which reports they distrust, in order."""
        numbered = enumerate(self.entries, start=1)
        groups = groupby(numbered, key=lambda entry: entry[1][1][0].distrusts)
        return [[number for number, _ in group] for _, group in groups]

    def trust(self, model: clingo.Model) -> Iterator[int]:
        """Assumptions: the same reports and attempts are distrusted as in a model."""
        for step, action in self.suffix.distrustable:
            literal = self.session.literal("distrusted", action, step)
            if literal is not None:
                yield literal if model.is_true(literal) else -literal


def _with_room(rank: Symbol) -> Symbol:
    """ranks(M) with as many places more as there are entries; other facts as they are."""
    if not rank.match("ranks", 1):
        return rank
    return fact("ranks", rank.arguments[0].number + MOST_ENTRIES)
