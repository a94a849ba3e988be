"""A history as the kept controls are asked about it: its records made once, its past folded."""

from __future__ import annotations

from collections.abc import Callable

from agents.shared.history import GOAL, History, Moment
from agents.shared.knowledge import Knowledge
from agents.shared.sessions import tools_of
from asp.reasoning.diagnosis import Folding, Pace, Past, Record
from asp.solving import LimitError, State

PACE = Pace()


class Memory:
    """The records of one history, which grows, and its folded past if its start is known."""

    def __init__(
        self,
        knowledge: Knowledge,
        goal: tuple[str, ...],
        since: int,
        holds: Callable[[State], bool],
        pace: Pace,
    ) -> None:
        """`since` is the first step at which an event may have occurred."""
        self._knowledge = knowledge
        self._goal = goal
        self._since = since
        self._holds = holds
        self._pace = pace
        self._records: dict[int, Record] = {}
        self._late_news = 0
        self._next = 0
        self._folding: Folding | None = None

    @property
    def folding(self) -> Folding | None:
        """The folded past; None as long as nothing is folded."""
        return self._folding if self._folding is not None and self._folding.step else None

    def record(self, history: History) -> None:
        """Takes over what is new in the history."""
        changed = 0 if history.late_news > self._late_news else self._next
        first = None
        for step in range(changed, history.step + 1):
            record = record_of(self._knowledge, history.moments.get(step, Moment()))
            if first is None and record != self._records.get(step):
                first = step
            self._records[step] = record
        if self._folding is not None and first is not None and first <= self._folding.step + 1:
            self._folding = None  # it may have begun with the step after the last one
        self._late_news, self._next = history.late_news, history.step

    def fold(self, history: History) -> None:
        """Folds a little more of the past, where its start is known.

        Where the decision reaches one of its limits, this is left for later: it only saves time.
        """
        if history.step <= self._pace.after or self.unknown(history):
            return
        try:
            if self._folding is None:
                self._folding = self._begun()
            if self._folding is not None:
                self._folding.follow(self._records, history.step)
        except LimitError:
            pass

    def past(self, history: History) -> Past:
        """All that there is to explain."""
        return Past(self._goal, dict(self._records), history.step, self._since)

    def unknown(self, history: History) -> list[str]:
        """The inertial fluents of which nothing was observed at step 0."""
        known = history.at(0).observed
        return [fluent for fluent in self._knowledge.description.inertial if fluent not in known]

    def _begun(self) -> Folding | None:
        tools = tools_of(self._knowledge)
        start = tools.explanations.smallest(Past(self._goal, {0: self._records[0]}, 0, 0))
        if start is None:
            return None
        folding = Folding(
            tools.transitions,
            tools.windows,
            self._knowledge.description.exogenous_actions,
            self._holds,
            self._since,
            self._pace,
        )
        folding.begin(start)
        return folding


def past_of(knowledge: Knowledge, goal: tuple[str, ...], history: History, since: int) -> Past:
    """A history as the kept controls are asked about it."""
    records = {step: record_of(knowledge, moment) for step, moment in history.moments.items()}
    return Past(goal, records, history.step, since)


def record_of(knowledge: Knowledge, moment: Moment) -> Record:
    """A moment without the mental part of the theory."""
    own, others = knowledge.actions
    physical = next((a for a in moment.attempted if a in own), None)
    return Record(
        observed=tuple(
            fluent if truth else f"-{fluent}"
            for fluent, truth in moment.trusted.items()
            if fluent != GOAL
        ),
        attempt=None if physical is None else (physical, moment.happened[physical]),
        failing=physical in moment.failing,
        reported=tuple(a for a, truth in moment.happened.items() if truth and a in others),
        goal=moment.trusted.get(GOAL),
    )
