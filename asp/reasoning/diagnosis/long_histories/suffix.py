"""The end of a history as a question to a kept control, with what a frontier knows of the rest."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from itertools import groupby

import clingo

from asp.reasoning.diagnosis.encoding import Past, distrustable
from asp.reasoning.diagnosis.long_histories.frontier import Frontier
from asp.reasoning.diagnosis.long_histories.prefix_explanations import Prefix
from asp.solving import Session, State

MOST_MORE = 4
"""How many events and distrusted reports a control counts, beyond those of the cheapest entry."""


@dataclass(frozen=True)
class Question:
    """A control switched to the end of a past, and what the frontier's entries lead to.

    `entries` are in the order of their explanations, numbered from 1; `most` is the size up to
    which they are complete. `given` are assumptions for all that was observed.
    """

    kept: Session
    frontier: Frontier
    end: Past
    most: int
    entries: Sequence[tuple[State, Sequence[Prefix]]]
    given: list[int]
    inertial: Sequence[str]

    def at_most(self, size: int) -> list[int]:
        """Assumptions for at most so many events and distrusted reports in the whole history."""
        room = size - self.frontier.least
        more = self.kept.literal("count", self.end.step, room + 1) if room < MOST_MORE else None
        return self.given if more is None else [*self.given, -more]

    def offering(self, entries: Iterable[int]) -> set[int]:
        """The externals that make these entries available, with their states and prices."""
        kept, wanted = self.kept, set[int | None]()
        for entry in entries:
            state, prefixes = self.entries[entry - 1]
            wanted.add(kept.literal("available", entry))
            wanted |= {kept.literal("has", entry, f) for f in self.inertial if f in state}
            dearer = prefixes[0].size - self.frontier.least
            wanted |= {kept.literal("price", entry, number) for number in range(1, dearer + 1)}
        return {literal for literal in wanted if literal is not None}

    @property
    def alike(self) -> list[list[int]]:
        """The numbers of the entries, grouped by which reports they distrust, in order."""
        numbered = enumerate(self.entries, start=1)
        groups = groupby(numbered, key=lambda entry: entry[1][1][0].distrusts)
        return [[number for number, _ in group] for _, group in groups]

    def trust(self, model: clingo.Model) -> Iterator[int]:
        """Assumptions: the same reports and attempts are distrusted as in a model."""
        for step, action in distrustable(self.end):
            literal = self.kept.literal("distrusted", action, step)
            if literal is not None:
                yield literal if model.is_true(literal) else -literal
