"""The states that a history may have led to, each with the smallest explanations that lead there.

Whatever is explained later is explained by one of these and by events after it: of explanations
that lead to the same state only the smallest can belong to a smallest one of the whole, and of
those that are equally small only the first in the order of `order.lp` to the first one. The states
that take more than `limit` events are left out, so that a frontier knows all explanations of a
history with at most so many. Where the same events may lead to several states, the order does not
say to which, and nothing is compressed. The end of the history is explained from each state of the
frontier, as a history of which all is known at first.
"""

from collections.abc import Callable, Collection, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace

from asp.reasoning.diagnosis.belief import BeliefTracker
from asp.reasoning.diagnosis.explanations import Alternatives, Explanation
from asp.reasoning.diagnosis.history import Happening, History, Problem, Record, record_of
from asp.reasoning.diagnosis.smallest_explanations import (
    FEW,
    Interpretation,
    Question,
    SmallestExplanations,
)
from asp.solving import BudgetError, Recent, State

REMEMBERED = 4_000
"""The greatest number of states and actions whose transitions are remembered."""

LENGTH = 24
"""How many steps the end of a history may have."""

_BRANCHES_OF_AN_ENTRY = 4
_STEPS_OF_A_DECISION = 3
_INFINITE = float("inf")
_ATTEMPT, _END, _REPORT = range(3)

_Branches = Sequence[tuple[Explanation, State]]
"""What may have happened at one step, with the states that it leads to."""


@dataclass(frozen=True)
class Compression:
    """How a history is compressed.

    From step `after` on, so that `lag` steps are left at the end; with a limit that is `margin`
    above the smallest explanation; at most `most` states and `kept` explanations of each; and
    with so many `answers` of the solver at each step.
    """

    after: int = 64
    lag: int = 12
    margin: int = 2
    most: int = 64
    kept: int = 3
    answers: int = 48


class Frontier:
    """The entries of a step of one history whose initial state is known; it advances by steps.

    Where there are more states than the settings allow, `limit` is lowered; where the smallest
    explanation reaches the limit, it begins anew with a higher one. `entries` are the smallest
    explanations of each state in their order: `kept` of them, and one more where there are more.
    """

    def __init__(
        self,
        ends: SmallestExplanations,
        tracker: BeliefTracker,
        settings: Compression,
        start: Interpretation,
    ) -> None:
        """`ends` are of histories that do not begin, `start` is how this one began."""
        self._ends = ends
        self._tracker = tracker
        self._settings = settings
        events = tracker.knowledge.description.exogenous_actions
        self._places: Mapping[str, int] = {event: place for place, event in enumerate(events)}
        self._branches: Recent[object, _Branches | None] = Recent(REMEMBERED)
        self._start = start
        self._begin(settings.margin)

    def _begin(self, limit: int) -> None:
        self.step, self.limit, self._aim = 0, limit, limit
        self.entries: Mapping[State, Sequence[Interpretation]] = {self._start.state: [self._start]}

    @property
    def least(self) -> int:
        """The size of the smallest explanation; one more than the limit where there is none."""
        sizes = (entry[0].explanation.size for entry in self.entries.values())
        return min(sizes, default=self.limit + 1)

    def smallest(self, problem: Problem, fewest: int) -> Interpretation | None:
        """The first of the smallest explanations of a history, not smaller than `fewest`.

        None where the frontier does not know all of those that are as small. Raises LimitError.
        """
        for size in range(max(fewest, self.least), self._largest(problem) + 1):
            found = [
                entry[0].followed_by(end, self.step)
                for entry, question, room in self._entries(problem, size)
                if (end := question.first(room)) is not None
            ]
            if found:
                return min(found, key=lambda whole: self._order(whole.explanation))
        return None

    def alternatives(self, problem: Problem, size: int, most: int) -> Alternatives | None:
        """At most so many explanations of the smallest size, and whether there are more of them.

        None where the frontier does not know. Raises LimitError.
        """
        if not self.least <= size <= self._largest(problem):
            return None
        found: list[Explanation] = []
        more = False
        for entry, question, room in self._entries(problem, size):
            ends, left_off = question.all(room, None, most)
            prefixes = entry[: self._settings.kept]
            found += (
                prefix.explanation.followed_by(end, self.step)
                for end, _ in ends
                for prefix in prefixes
            )
            more = more or left_off or (bool(ends) and len(prefixes) < len(entry))
        return found[:most], more or len(found) > most

    def follow(self, history: History) -> None:
        """Compresses a little more of a history.

        Raises LimitError, also where that takes more answers of the solver than are allowed; those
        that it has are remembered.
        """
        settings, known = self._settings, self._tracker.knowledge
        self._answers = settings.answers
        until = min(history.step - settings.lag, self.step + _STEPS_OF_A_DECISION)
        while self.step < until:
            record, after = (record_of(history.at(self.step + i), known) for i in range(2))
            while (entries := self._next(record, after)) is None:
                self.limit -= 1
            self.step, self.entries = self.step + 1, entries
        wanted = self.least + settings.margin
        if self.least >= self.limit and wanted > self._aim:
            self._begin(wanted)

    def _largest(self, problem: Problem) -> int:
        """The size up to which all explanations of a history are found; -1 where it is too long."""
        is_short = problem.step - self.step <= LENGTH
        return min(self.limit, self.least + FEW) if is_short else -1

    def _entries(
        self, problem: Problem, size: int
    ) -> Iterator[tuple[Sequence[Interpretation], Question, int]]:
        """Entries of at most a size, with the end of the history from there, and what is left."""
        question = self._ends.question(problem.suffix(self.step), FEW)
        for state, entry in self.entries.items():
            room = size - entry[0].explanation.size
            if room >= 0:
                yield entry, question.starting(state), room

    def _next(
        self, record: Record, following: Record
    ) -> Mapping[State, Sequence[Interpretation]] | None:
        """The entries of the next step; None where there are too many within the limit."""
        found: dict[State, list[Interpretation]] = {}
        happened, agrees = replace(record, observed=(), goal=None), self._observed(following)
        for state, entry in self.entries.items():
            room = self.limit - entry[0].explanation.size
            if room >= 0:
                branches = self._from(state, happened, room)
                if branches is None:
                    return None
                for explanation, after in branches:
                    if agrees(after):
                        self._extend(found, entry, explanation, after)
        if len(found) > self._settings.most:
            return None
        return {state: self._first(entry) for state, entry in found.items()}

    def _from(self, state: State, record: Record, room: int) -> _Branches | None:
        if self.step < self._tracker.since:
            room = -1
        return self._branches.get((state, record, room), lambda: self._look(state, record, room))

    def _look(self, state: State, record: Record, room: int) -> _Branches | None:
        """The branches of a state; None where they are too many, or not deterministic."""
        if self._answers <= 0:
            raise BudgetError("no more is compressed in this decision")
        most = self._settings.most * _BRANCHES_OF_AN_ENTRY
        problem = Problem(self._tracker.goal, {0: record}, step=1, since=0 if room >= 0 else 1)
        found, left_off = self._ends.outcomes(problem).starting(state).all(room, None, most)
        self._answers -= 2 + (most if left_off else len(found))
        # Of several outcomes of the same events the order says nothing.
        several = len({explanation for explanation, _ in found}) < len(found)
        return None if left_off or several else found

    def _observed(self, following: Record) -> Callable[[State], bool]:
        """Whether a state agrees with what was observed of it."""
        true = frozenset(each for each in following.observed if each.is_positive)
        false = frozenset(each.atom for each in following.observed) - true
        return lambda state: (
            true <= state
            and false.isdisjoint(state)
            and following.goal in (None, self._tracker.holds(state))
        )

    def _extend(
        self,
        found: dict[State, list[Interpretation]],
        entry: Sequence[Interpretation],
        explanation: Explanation,
        after: State,
    ) -> None:
        """Adds the explanations of a state with what a branch assumes, if none there is smaller."""
        there, size = found.setdefault(after, []), entry[0].explanation.size + explanation.size
        if there and there[0].explanation.size < size:
            return
        if there and there[0].explanation.size > size:
            there.clear()
        held = frozenset([1] if self._tracker.holds(after) else [])
        end = Interpretation(explanation, frozenset(), after, held)
        there += (prefix.followed_by(end, self.step) for prefix in entry)

    def _first(self, entry: list[Interpretation]) -> Sequence[Interpretation]:
        if len(entry) == 1:
            return entry
        in_order = sorted(entry, key=lambda prefix: self._order(prefix.explanation))
        return in_order[: self._settings.kept + 1]

    def _order(self, explanation: Explanation) -> tuple[list[tuple[float, ...]], ...]:
        """Its place (`order.lp`): what is distrusted, the latest first; then events are late."""
        # An attempt has no place among exogenous actions: it comes before the end, which comes
        # before a report.
        distrusted: list[tuple[float, ...]] = [
            (_REPORT, step, -place) if place >= 0 else (_ATTEMPT, -step)
            for step, place in self._latest_first(explanation.distrusted)
        ]
        assumed: list[tuple[float, ...]] = [
            (-step, place) for step, place in self._latest_first(explanation.unobserved)
        ]
        return [*distrusted, (_END,)], [*assumed, (_INFINITE,)]

    def _latest_first(self, happenings: Collection[Happening]) -> list[tuple[int, int]]:
        """The steps and places of happenings, at one step in the order of their places."""
        placed = [(step, self._places.get(action, -1)) for step, action in happenings]
        return sorted(placed, key=lambda pair: (-pair[0], pair[1]))
