"""Smallest explanations of a history of which only the end is explained, from a frontier on."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

import clingo
from clingo import Symbol

from asp.reasoning.diagnosis.encoding import (
    Account,
    Assumed,
    Past,
    account,
    assumed,
    externals,
    is_true,
    observations,
)
from asp.reasoning.diagnosis.long_histories.frontier import Frontier
from asp.reasoning.diagnosis.long_histories.prefix_explanations import steps
from asp.reasoning.diagnosis.long_histories.suffix import MOST_MORE, Question
from asp.solving import (
    Session,
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


class Windows:
    """What explains the end of a history in one domain, and with it the whole."""

    def __init__(
        self,
        program: str,
        fluents: Sequence[str],
        inertial: Sequence[str],
        events: Sequence[str],
        ranks: Iterable[Symbol],
    ) -> None:
        """`ranks` are the facts rank(A,R) and ranks(M)."""
        self._program = "\n".join([program, theory("order")])
        self._fluents = fluents
        self._inertial = inertial
        self._events = events
        self._ranks = [_with_room(rank) for rank in ranks]
        self._made: Session | None = None
        self._on: set[int] = set()

    def smallest(self, frontier: Frontier, past: Past, fewest: int) -> Account | None:
        """The first of the smallest explanations of a past, not smaller than `fewest`.

        None where the frontier does not know all of those that are as small.
        """
        question = self._question(frontier, past)
        if question is None:
            return None
        for size in range(max(fewest, frontier.least), question.most + 1):
            found = self._first(question, size)
            if found is not None:
                return found
        return None

    def alternatives(
        self, frontier: Frontier, past: Past, size: int, most: int
    ) -> tuple[list[Assumed], bool] | None:
        """At most so many explanations of the smallest size, and whether there are more of them.

        None where the frontier does not know.
        """
        question = self._question(frontier, past)
        if question is None or not frontier.least <= size <= question.most:
            return None
        shown, more = answer_sets(question.kept.control, question.at_most(size), most)
        found: list[Assumed] = []
        for answer in shown:
            (entry,) = (s.arguments[0].number for s in answer if s.name == "from")
            end = assumed(s for s in answer if s.name != "from")
            prefixes, left_off = frontier.told(question.entries[entry - 1][1])
            found += (prefix.followed_by(end, frontier.step) for prefix in prefixes)
            more = more or left_off
        return found[:most], more or len(found) > most

    def _first(self, question: Question, size: int) -> Account | None:
        """The first explanation with at most so many events and distrusted reports."""
        control, limited = question.kept.control, question.at_most(size)
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

    def _question(self, frontier: Frontier, past: Past) -> Question | None:
        """The control with the end of a past and the entries of a frontier; None: too many."""
        end = past.from_step(frontier.step)
        most = min(frontier.limit, frontier.least + MOST_MORE)
        known = [
            (state, prefixes)
            for state, prefixes in frontier.entries.items()
            if prefixes[0].size <= most
        ]
        if not known or len(known) > MOST_ENTRIES or end.step > LENGTH:
            return None
        kept = self._kept
        kept.switch_on(*goal_externals(past.goal), *externals(end))
        given = observations(kept, end)
        if given is None:
            return None
        entries = sorted(known, key=lambda entry: entry[1][0].order)
        question = Question(kept, frontier, end, most, entries, given, self._inertial)
        self._offer(question, range(1, len(entries) + 1))
        return question

    def _offer(self, question: Question, entries: Iterable[int]) -> None:
        """Makes exactly these entries available."""
        on = question.offering(entries)
        with undisturbed():
            for literal in self._on ^ on:
                question.kept.control.assign_external(literal, literal in on)
            self._on = on

    def _read(self, question: Question, model: clingo.Model) -> Account:
        """An account of the whole history, but for how it began and its exceptions."""
        kept, first = question.kept, question.frontier.step
        end = account(kept, model, question.end, self._events, ())
        prefixes = next(
            prefixes
            for number, (_, prefixes) in enumerate(question.entries, start=1)
            if is_true(model, kept.literal("from", number))
        )
        held = frozenset(first + step for step in end.held).union(steps(prefixes[0].held))
        return Account(prefixes[0].followed_by(end.assumed, first), frozenset(), end.state, held)

    @property
    def _kept(self) -> Session:
        if self._made is None:
            self._made = Session(
                self._program,
                "incremental_diagnosis",
                self._fluents,
                self._ranks,
                ["suffix"],
                n=LENGTH,
                most=MOST_MORE,
                entries=MOST_ENTRIES,
            )
        return self._made


def _with_room(rank: Symbol) -> Symbol:
    """ranks(M) with as many places more as there are entries; other facts as they are."""
    if not rank.match("ranks", 1):
        return rank
    return fact("ranks", rank.arguments[0].number + MOST_ENTRIES)
