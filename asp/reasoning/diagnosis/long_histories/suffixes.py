"""Smallest explanations of a history of which only the end is explained, from a frontier on."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property, lru_cache
from itertools import chain, groupby

from clingo import Symbol

from asp.reasoning.diagnosis.encoding import (
    Interpretation,
    Problem,
    explanation_of,
    interpretation,
    observations,
)
from asp.reasoning.diagnosis.history import Explanation
from asp.reasoning.diagnosis.long_histories.frontier import MOST_ENTRIES, Frontier, joined
from asp.reasoning.knowledge import Knowledge
from asp.solving import Session, answer_sets, fact, goal_externals, preferring, theory

LENGTH = 24
"""How many steps the end of a history may have."""

MOST_MORE = 4
"""How many events and distrusted reports a session counts, beyond those of the cheapest entry."""

_external = lru_cache(MOST_ENTRIES * 1_000)(fact)


@dataclass(frozen=True)
class _Question:
    """The end of a history, and what the frontier's entries lead to.

    `entries` are in the order of their explanations, numbered from 1; `most` is the size up to
    which they are complete. `given` are assumptions for all that was observed.
    """

    frontier: Frontier
    suffix: Problem
    entries: Sequence[Sequence[Interpretation]]
    most: int
    given: list[int]


class SuffixExplanations:
    """What explains the end of a history in one domain, and with it the whole."""

    def __init__(self, knowledge: Knowledge) -> None:
        self._knowledge = knowledge

    def smallest(self, frontier: Frontier, problem: Problem, fewest: int) -> Interpretation | None:
        """The first of the smallest explanations of a history, not smaller than `fewest`.

        None where the frontier does not know all of those that are as small. Raises LimitError.
        """
        question = self._question(frontier, problem)
        if question is None:
            return None
        sizes = range(max(fewest, frontier.least), question.most + 1)
        found = (self._first(question, size) for size in sizes)
        return next(filter(None, found), None)

    def alternatives(
        self, frontier: Frontier, problem: Problem, size: int, most: int
    ) -> tuple[list[Explanation], bool] | None:
        """At most so many explanations of the smallest size, and whether there are more of them.

        None where the frontier does not know. Raises LimitError.
        """
        question = self._question(frontier, problem)
        if question is None or not frontier.least <= size <= question.most:
            return None
        self._offer(question, range(1, len(question.entries) + 1))
        limited = self._at_most(question, size)
        shown, more = answer_sets(self._session.control, limited, most)
        found: list[Explanation] = []
        for answer in shown:
            prefixes, left_off = frontier.told(question.entries[_entry(answer) - 1])
            end = Interpretation(explanation_of(answer), frozenset(), frozenset(), frozenset())
            found += (joined(prefix, end, frontier.step).explanation for prefix in prefixes)
            more = more or left_off
        return found[:most], more or len(found) > most

    def _first(self, question: _Question, size: int) -> Interpretation | None:
        """The first explanation with at most so many events and distrusted reports."""
        numbered = enumerate(question.entries, start=1)
        groups = groupby(numbered, key=lambda entry: entry[1][0].explanation.distrusted)
        alike = [[number for number, _ in group] for _, group in groups]
        limited = self._at_most(question, size)
        found = self._preferred(question, limited, chain(*alike))
        if found is None or len(alike) == 1:
            return found
        # Which reports are distrusted before the end comes before which events are assumed in it.
        trusted = [*limited, *self._trust(question, found)]
        every = (self._preferred(question, trusted, entries) for entries in alike)
        return next(filter(None, every))

    def _preferred(
        self, question: _Question, assumptions: Sequence[int], entries: Iterable[int]
    ) -> Interpretation | None:
        """The interpretation of the whole history that comes first from some of the entries."""
        self._offer(question, entries)
        with preferring(self._session.control, assumptions) as model:
            if model is None:
                return None
            prefixes = question.entries[_entry(model.symbols(shown=True)) - 1]
            end = interpretation(self._session, model, question.suffix)
            return joined(prefixes[0], end, question.frontier.step)

    def _trust(self, question: _Question, found: Interpretation) -> Iterator[int]:
        """Assumptions: the same reports and attempts are distrusted of the end."""
        first = question.frontier.step
        for step, record in question.suffix.records.items():
            for action in record.distrustable if step < question.suffix.step else ():
                literal = self._session.literal("distrusted", action, step)
                if literal is not None:
                    there = (first + step, action) in found.explanation.distrusted
                    yield literal if there else -literal

    def _question(self, frontier: Frontier, problem: Problem) -> _Question | None:
        """The end of a history and the entries of a frontier; None where these are too many."""
        suffix = problem.suffix(frontier.step)
        most = min(frontier.limit, frontier.least + MOST_MORE)
        known = [e for e in frontier.entries.values() if e[0].explanation.size <= most]
        if not known or len(known) > MOST_ENTRIES or suffix.step > LENGTH:
            return None
        given = observations(self._session, suffix)
        if given is None:
            return None
        entries = sorted(known, key=lambda entry: frontier.order(entry[0].explanation))
        return _Question(frontier, suffix, entries, most, given)

    def _offer(self, question: _Question, numbers: Iterable[int]) -> None:
        """Makes exactly these entries available, with their states and prices."""
        suffix, sizes = question.suffix, [e[0].explanation.size for e in question.entries]
        wanted = [*goal_externals(suffix.goal), *suffix.externals]
        for number in numbers:
            state = question.entries[number - 1][0].state
            wanted.append(_external("available", number))
            wanted += (_external("has", number, fluent) for fluent in state & self._inertial)
            dearer = sizes[number - 1] - min(sizes)
            wanted += (_external("price", number, more) for more in range(1, dearer + 1))
        self._session.switch_on(*wanted)

    def _at_most(self, question: _Question, size: int) -> list[int]:
        """Assumptions for at most so many events and distrusted reports in the whole history."""
        room, step = size - question.frontier.least, question.suffix.step
        more = self._session.literal("count", step, room + 1) if room < MOST_MORE else None
        return question.given if more is None else [*question.given, -more]

    @cached_property
    def _inertial(self) -> frozenset[str]:
        return frozenset(self._knowledge.description.inertial)

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


def _entry(shown: Sequence[Symbol]) -> int:
    """Which entry an explanation goes on from."""
    (number,) = (symbol.arguments[0].number for symbol in shown if symbol.match("from", 1))
    return number


def _with_room(rank: Symbol) -> Symbol:
    """ranks(M) with as many places more as there are entries; other facts as they are."""
    if not rank.match("ranks", 1):
        return rank
    return fact("ranks", rank.arguments[0].number + MOST_ENTRIES)
