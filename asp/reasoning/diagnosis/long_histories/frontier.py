"""The states that a history may have led to, each with the smallest explanations that lead there.

Whatever is explained later is explained by one of these and by events after it: of explanations
that lead to the same state only the smallest can belong to a smallest one of the whole, and of
those that are equally small only the first in the order of `order.lp` to the first one. The states
that take more than `limit` events are left out, so that a frontier knows all explanations of a
history with at most so many. Where the same events may lead to several states, the order does not
say to which, and nothing is compressed.
"""

from collections.abc import Callable, Collection, Mapping, Sequence
from dataclasses import dataclass

from asp.reasoning.diagnosis.belief import BeliefTracker
from asp.reasoning.diagnosis.encoding import Interpretation
from asp.reasoning.diagnosis.history import Explanation, Happening, Record
from asp.reasoning.successors import Branch
from asp.solving import BudgetError, Recent, State

REMEMBERED = 4_000
"""The greatest number of states and actions whose transitions are remembered."""

_BRANCHES_OF_AN_ENTRY = 4
_STEPS_OF_A_DECISION = 3
_INFINITE = float("inf")
_ATTEMPT, _END, _REPORT = range(3)


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
        self, tracker: BeliefTracker, settings: Compression, start: Interpretation
    ) -> None:
        """`start` is how the history began."""
        self._tracker = tracker
        self._settings = settings
        self.kept = settings.kept
        events = tracker.knowledge.description.exogenous_actions
        self._places: Mapping[str, int] = {event: place for place, event in enumerate(events)}
        self._branches: Recent[tuple[object, ...], Sequence[Branch] | None] = Recent(REMEMBERED)
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

    def order(self, explanation: Explanation) -> tuple[list[tuple[float, ...]], ...]:
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

    def follow(self, records: Mapping[int, Record], step: int) -> None:
        """Compresses a little more of a history that has reached a step.

        Raises LimitError, also where that takes more answers of the solver than are allowed; those
        that it has are remembered.
        """
        settings = self._settings
        self._answers = settings.answers
        until = min(step - settings.lag, self.step + _STEPS_OF_A_DECISION)
        while self.step < until:
            record, following = records[self.step], records[self.step + 1]
            while (entries := self._next(record, following)) is None:
                self.limit -= 1
            self.step, self.entries = self.step + 1, entries
        wanted = self.least + settings.margin
        if self.least >= self.limit and wanted > self._aim:
            self._begin(wanted)

    def _next(
        self, record: Record, following: Record
    ) -> Mapping[State, Sequence[Interpretation]] | None:
        """The entries of the next step; None where there are too many within the limit."""
        found: dict[State, list[Interpretation]] = {}
        agrees = self._observed(record, following)
        for state, entry in self.entries.items():
            room = self.limit - entry[0].explanation.size
            if room >= 0:
                branches = self._from(state, record, room)
                if branches is None:
                    return None
                for branch in filter(agrees, branches):
                    self._extend(found, entry, branch)
        if len(found) > self._settings.most:
            return None
        return {state: self._first(entry) for state, entry in found.items()}

    def _from(self, state: State, record: Record, room: int) -> Sequence[Branch] | None:
        if self.step < self._tracker.since:
            room = -1
        key = state, record.action, record.failing, record.reported, room
        return self._branches.get(key, lambda: self._look(state, record, room))

    def _look(self, state: State, record: Record, room: int) -> Sequence[Branch] | None:
        """The branches of a state; None where they are too many, or not deterministic."""
        if self._answers <= 0:
            raise BudgetError("no more is compressed in this decision")
        most = self._settings.most * _BRANCHES_OF_AN_ENTRY
        found = self._tracker.transitions.branches(
            state, record.action, record.reported, room, most, record.failing
        )
        self._answers -= 2 + (most if found is None else len(found))
        # Of several outcomes of the same events the order says nothing.
        if found is None or len({(b.events, b.distrusted) for b in found}) < len(found):
            return None
        return found

    def _observed(self, record: Record, following: Record) -> Callable[[Branch], bool]:
        """Whether a branch agrees with what was observed of a step."""
        true = frozenset(each for each in following.observed if each.is_positive)
        false = frozenset(each.atom for each in following.observed) - true
        return lambda branch: (
            (record.attempt is None or record.attempt[1] == branch.took_effect)
            and true <= branch.state
            and false.isdisjoint(branch.state)
            and following.goal in (None, self._tracker.holds(branch.state))
        )

    def _extend(
        self,
        found: dict[State, list[Interpretation]],
        entry: Sequence[Interpretation],
        branch: Branch,
    ) -> None:
        """Adds the explanations of a state with what a branch assumes, if none there is smaller."""
        there, size = found.setdefault(branch.state, []), entry[0].explanation.size + branch.size
        if there and there[0].explanation.size < size:
            return
        if there and there[0].explanation.size > size:
            there.clear()
        assumed = Explanation(
            tuple(sorted(Happening(0, event) for event in branch.events)),
            tuple(sorted(Happening(0, action) for action in branch.distrusted)),
        )
        held = frozenset([1] if self._tracker.holds(branch.state) else [])
        end = Interpretation(assumed, frozenset(), branch.state, held)
        there += (joined(prefix, end, self.step) for prefix in entry)

    def _first(self, entry: list[Interpretation]) -> Sequence[Interpretation]:
        if len(entry) == 1:
            return entry
        in_order = sorted(entry, key=lambda prefix: self.order(prefix.explanation))
        return in_order[: self.kept + 1]

    def _latest_first(self, happenings: Collection[Happening]) -> list[tuple[int, int]]:
        """The steps and places of happenings, at one step in the order of their places."""
        placed = [(step, self._places.get(action, -1)) for step, action in happenings]
        return sorted(placed, key=lambda pair: (-pair[0], pair[1]))


def joined(prefix: Interpretation, suffix: Interpretation, first: int) -> Interpretation:
    """The interpretation of a history that is explained anew from step `first` on."""
    explanation = prefix.explanation.followed_by(suffix.explanation, first)
    held = prefix.held.union(first + step for step in suffix.held)
    return Interpretation(explanation, prefix.initial, suffix.state, held)
