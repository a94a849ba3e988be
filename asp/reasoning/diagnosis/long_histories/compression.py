"""One history of which the past is folded into a frontier: what came long ago is explained once."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace

from asp.reasoning.diagnosis.encoding import Account, Assumed, Past, Record
from asp.reasoning.diagnosis.long_histories.frontier import Frontier
from asp.reasoning.diagnosis.long_histories.prefix_explanations import steps
from asp.reasoning.diagnosis.long_histories.suffix_explanations import MOST_ENTRIES, Windows
from asp.reasoning.successors import Transitions
from asp.solving import State


@dataclass(frozen=True)
class Pace:
    """How a history is folded.

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


class Folding:
    """Smallest explanations of one history whose initial state is known.

    What it answers is what the theory says of the whole history. Where it cannot tell, it says so:
    where its frontier does not know all explanations that may be as small, or lies too far back.
    """

    def __init__(
        self,
        transitions: Transitions,
        windows: Windows,
        events: Sequence[str],
        holds: Callable[[State], bool],
        since: int,
        pace: Pace,
    ) -> None:
        """`events` are the exogenous actions as declared, `holds` says whether the goal does."""
        self._transitions = transitions
        self._windows = windows
        self._events = events
        self._holds = holds
        self._since = since
        self._pace = pace

    def begin(self, start: Account) -> None:
        """Starts anew, with an account of step 0."""
        self._start = start
        self._front = self._made(self._pace.margin)
        self._wider: Frontier | None = None
        self._smallest: tuple[int, int] | None = None
        self._too_wide_at = -1

    @property
    def step(self) -> int:
        """The step up to which the history is folded."""
        return self._front.step

    @property
    def size(self) -> int:
        """How much it keeps, in explanations and transitions; it has a bound."""
        return self._front.size + (self._wider.size if self._wider else 0)

    def follow(self, records: Mapping[int, Record], step: int) -> None:
        """Folds a little more of a history that has reached a step. Raises LimitError."""
        if step <= self._pace.after:
            return
        left = self._advance(self._front, records, step, self._pace.work)
        self._widen(records, step, left)

    def smallest(self, past: Past, fewest: int) -> Account | None:
        """The first of the smallest explanations, not smaller than `fewest`; None: cannot tell.

        Raises LimitError.
        """
        found = self._windows.smallest(self._front, past, fewest) if self.step else None
        self._smallest = None if found is None else (past.step, found.assumed.size)
        if found is None:
            return None
        return replace(found, assumed=self._whole(found.assumed), initial=self._start.initial)

    def alternatives(self, past: Past, size: int, most: int) -> tuple[list[Assumed], bool] | None:
        """At most so many explanations of the smallest size, and whether there are more of them.

        None where it did not find that size for this step. Raises LimitError.
        """
        if not self.step or self._smallest != (past.step, size):
            return None
        found = self._windows.alternatives(self._front, past, size, most)
        return found and ([self._whole(assumed) for assumed in found[0]], found[1])

    def along(self, assumed: Assumed) -> tuple[State, frozenset[int]] | None:
        """The state at `step` under an explanation, and when the goal held; None: not known."""
        before = Assumed(
            tuple(event for event in assumed.events if event[0] < self.step),
            tuple(report for report in assumed.distrusted if report[0] < self.step),
        )
        for state, prefixes in self._front.entries.items() if self.step else ():
            for prefix in prefixes:
                if prefix.is_of(before):
                    return state, frozenset(steps(prefix.held))
        return None

    def _whole(self, assumed: Assumed) -> Assumed:
        return replace(assumed, exceptions=tuple(sorted(self._start.assumed.exceptions)))

    def _advance(
        self, frontier: Frontier, records: Mapping[int, Record], step: int, work: int
    ) -> int:
        """Brings a frontier forward as far as the work suffices; what is left of it."""
        while work > 0 and frontier.step < step - self._pace.lag:
            at = frontier.step
            work = frontier.advance(_at(records, at), _at(records, at + 1), work)
        return work

    def _widen(self, records: Mapping[int, Record], step: int, work: int) -> None:
        """Makes a frontier with a higher limit, once the limit of the one in use is reached."""
        front, wider = self._front, self._wider
        if front.limit > front.least or front.least == self._too_wide_at:
            self._wider = None
            return
        if wider is None:
            wider = self._wider = self._made(front.least + self._pace.margin)
        self._advance(wider, records, step, work)
        if wider.limit <= front.limit:
            self._wider, self._too_wide_at = None, front.least
        elif wider.step >= front.step:
            self._front, self._wider = wider, None

    def _made(self, limit: int) -> Frontier:
        pace = self._pace
        frontier = Frontier(
            self._transitions, self._events, self._holds, self._since, pace.most, pace.kept
        )
        frontier.begin(self._start.initial, limit)
        return frontier


def _at(records: Mapping[int, Record], step: int) -> Record:
    return records.get(step, Record())
