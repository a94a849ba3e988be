"""History compression: what came long ago is explained once, and kept as a frontier of states."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace

from asp.reasoning.diagnosis.belief import BeliefTracker
from asp.reasoning.diagnosis.encoding import Interpretation, Problem
from asp.reasoning.diagnosis.history import Explanation, Record
from asp.reasoning.diagnosis.long_histories.prefixes import Frontier
from asp.reasoning.diagnosis.long_histories.suffixes import MOST_ENTRIES, SuffixExplanations
from asp.solving import State


@dataclass(frozen=True)
class Compression:
    """How a history is compressed.

    From step `after` on, so that `lag` steps are left at the end; with a limit that is `margin`
    above the smallest explanation; at most `most` states and `kept` explanations of each; and
    with so much `work` at each step, in calls of the solver.
    """

    after: int = 32
    lag: int = 12
    margin: int = 2
    most: int = MOST_ENTRIES
    kept: int = 3
    work: int = 48


class CompressedHistory:
    """Smallest explanations of one history whose initial state is known.

    What it answers is what the theory says of the whole history. Where it cannot tell, it says so:
    where its frontier does not know all explanations that may be as small, or lies too far back.
    """

    def __init__(
        self,
        tracker: BeliefTracker,
        suffixes: SuffixExplanations,
        settings: Compression,
        start: Interpretation,
    ) -> None:
        """`start` is how the history began."""
        self._tracker = tracker
        self._suffixes = suffixes
        self._settings = settings
        self._start = start
        self._front = self._made(settings.margin)
        self._wider: Frontier | None = None
        self._smallest: tuple[int, int] | None = None
        self._too_wide_at = -1

    @property
    def step(self) -> int:
        """The step up to which the history is compressed."""
        return self._front.step

    @property
    def size(self) -> int:
        """How much it keeps, in explanations and transitions; it has a bound."""
        return self._front.size + (self._wider.size if self._wider else 0)

    def follow(self, records: Mapping[int, Record], step: int) -> None:
        """Compresses a little more of a history that has reached a step. Raises LimitError."""
        left = self._advance(self._front, records, step, self._settings.work)
        self._widen(records, step, left)

    def smallest(self, problem: Problem, fewest: int) -> Interpretation | None:
        """The first of the smallest explanations, not smaller than `fewest`; None: cannot tell.

        Raises LimitError.
        """
        found = self._suffixes.smallest(self._front, problem, fewest) if self.step else None
        self._smallest = None if found is None else (problem.step, found.explanation.size)
        if found is None:
            return None
        whole = self._whole(found.explanation)
        return replace(found, explanation=whole, initial=self._start.initial)

    def alternatives(
        self, problem: Problem, size: int, most: int
    ) -> tuple[list[Explanation], bool] | None:
        """At most so many explanations of the smallest size, and whether there are more of them.

        None where it did not find that size for this step. Raises LimitError.
        """
        if not self.step or self._smallest != (problem.step, size):
            return None
        found = self._suffixes.alternatives(self._front, problem, size, most)
        return found and ([self._whole(explanation) for explanation in found[0]], found[1])

    def along(self, explanation: Explanation) -> tuple[State, frozenset[int]] | None:
        """The state at `step` under an explanation, and when the goal held; None: not known."""
        for state, prefixes in self._front.entries.items() if self.step else ():
            for prefix in prefixes:
                if prefix.begins(explanation, self.step):
                    return state, frozenset(prefix.steps_held)
        return None

    def _whole(self, explanation: Explanation) -> Explanation:
        return replace(explanation, exceptions=self._start.explanation.exceptions)

    def _advance(
        self, frontier: Frontier, records: Mapping[int, Record], step: int, work: int
    ) -> int:
        """Brings a frontier forward as far as the work suffices; what is left of it."""
        while work > 0 and frontier.step < step - self._settings.lag:
            at = frontier.step
            work = frontier.advance(records[at], records[at + 1], work)
        return work

    def _widen(self, records: Mapping[int, Record], step: int, work: int) -> None:
        """Makes a frontier with a higher limit, once the limit of the one in use is reached."""
        front, wider = self._front, self._wider
        if front.limit > front.least or front.least == self._too_wide_at:
            self._wider = None
            return
        if wider is None:
            wider = self._wider = self._made(front.least + self._settings.margin)
        self._advance(wider, records, step, work)
        if wider.limit <= front.limit:
            self._wider, self._too_wide_at = None, front.least
        elif wider.step >= front.step:
            self._front, self._wider = wider, None

    def _made(self, limit: int) -> Frontier:
        settings = self._settings
        start = self._start.initial
        return Frontier(self._tracker, settings.most, settings.kept, start, limit)
