"""The steps of one history: which arcs its states have, and which states were not observed away."""

from collections.abc import Callable, Sequence
from copy import copy
from dataclasses import replace

from asp.reasoning.diagnosis.belief import BeliefTracker
from asp.reasoning.diagnosis.history import History, Record, record_of
from asp.reasoning.diagnosis.long_histories.arcs import Arc, Arcs, Step
from asp.solving import BudgetError, State

ArcsOfState = Callable[[State, float], Sequence[Arc] | None]
"""The arcs of a state, of at most a size; None where they are not known. Raises LimitError."""


class Steps:
    """The steps of one history; `answers` of the solver are left for arcs that it had not yet.

    They count where they are remembered from another history, too, so that what is known of a
    history depends on it alone.
    """

    def __init__(self, arcs: Arcs, tracker: BeliefTracker, most: int) -> None:
        """`most` is the greatest number of arcs of a state."""
        self.answers = 0
        self._arcs = arcs
        self._tracker = tracker
        self._most = most
        self._seen: set[object] = set()
        self._crowded = False

    def copy(self) -> "Steps":
        """The steps so far of a history that may go on otherwise."""
        other = copy(self)
        other._seen = self._seen.copy()
        return other

    def record(self, history: History, step: int) -> Record:
        """What the history says of a step."""
        return record_of(history.at(step), self._tracker.knowledge)

    def arcs(self, history: History, step: int) -> ArcsOfState:
        """The arcs of states at a step; BudgetError is raised where too few answers are left.

        Where a state has too many of them, only those that agree with what was observed a step
        later are looked for; so it is with all states from then on.
        """
        happened = replace(self.record(history, step), observed=(), goal=None)
        whole = Step(happened, step >= self._tracker.since)
        seen = replace(whole, seen=self.record(history, step + 1).observed)

        def from_state(state: State, room: float) -> Sequence[Arc] | None:
            found = None if self._crowded else self._asked(state, whole, room)
            if found is None:
                self._crowded = True
                found = self._asked(state, seen, room)
            return found

        return from_state

    def _asked(self, state: State, step: Step, room: float) -> Sequence[Arc] | None:
        key = state, step, int(min(room, self._arcs.counted)), self._most
        if key in self._seen:
            return self._arcs.of(*key)
        if self.answers <= 0:
            raise BudgetError("no more is compressed in this decision")
        found = self._arcs.of(*key)
        self.answers -= 2 + (self._most if found is None else len(found))
        self._seen.add(key)
        return found

    def agreeing(self, history: History, step: int) -> Callable[[State], bool]:
        """Whether a state agrees with what was observed at a step."""
        record, verdicts = self.record(history, step), dict[State, bool]()
        true = frozenset(each for each in record.observed if each.is_positive)
        false = frozenset(each.atom for each in record.observed) - true

        def agrees(state: State) -> bool:
            if state not in verdicts:
                verdicts[state] = (
                    true <= state
                    and false.isdisjoint(state)
                    and record.goal in (None, self._tracker.holds(state))
                )
            return verdicts[state]

        return agrees
