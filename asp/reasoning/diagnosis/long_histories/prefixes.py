"""The states that a history may have led to, each with the smallest explanations that lead there.

Whatever is explained later is explained by one of these and by events after it: of explanations
that lead to the same state only the smallest can belong to a smallest one of the whole, and of
those that are equally small only the first in the order of `order.lp` to the first one. The states
that take more than `limit` events are left out, so that a frontier knows all explanations of a
history with at most so many. Where the same events may lead to several states, the order does not
say to which, and nothing is compressed.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace

from asp.language import atom, is_positive
from asp.reasoning.diagnosis.belief import BeliefTracker
from asp.reasoning.diagnosis.history import Explanation, Happening, Record
from asp.reasoning.successors import Branch
from asp.solving import State

REMEMBERED = 4_000
"""The greatest number of states and actions whose transitions are remembered."""

_WORK_OF_A_STEP, _WORK_OF_A_CALL = 16, 2
_INFINITE = float("inf")
_ATTEMPT, _END, _REPORT = range(3)

Steps = tuple[int, "Steps"] | None
"""Steps as a chain, the last one first."""


@dataclass(frozen=True)
class PrefixExplanation:
    """An explanation up to a step: its events, its distrusted reports and attempts, latest first.

    `distrusts` and `assumes` are its place in the order of explanations that are as small, the
    first part being compared with others before the second; `held` are the steps at which the goal
    held. In `distrusts` an attempt comes before the end, and the end before a report.
    """

    events: tuple[Happening, ...] = ()
    distrusted: tuple[Happening, ...] = ()
    distrusts: tuple[tuple[float, ...], ...] = ((_END,),)
    assumes: tuple[tuple[float, ...], ...] = ((_INFINITE,),)
    held: Steps = None

    @property
    def size(self) -> int:
        """How many events, and false reports and attempts, it assumes (27)."""
        return len(self.events) + len(self.distrusted)

    @property
    def order(self) -> tuple[object, ...]:
        """Its place (`order.lp`): what is distrusted, the latest first; then events are late."""
        return self.distrusts, self.assumes

    @property
    def steps_held(self) -> Iterator[int]:
        """The steps at which the goal held."""
        chain = self.held
        while chain is not None:
            step, chain = chain
            yield step

    def begins(self, explanation: Explanation, until: int) -> bool:
        """Whether it is what an explanation says of the steps before one."""
        return all(
            sorted(own) == [happening for happening in whole if happening.step < until]
            for own, whole in (
                (self.events, explanation.unobserved),
                (self.distrusted, explanation.distrusted),
            )
        )

    def extended(
        self, branch: Branch, step: int, places: Mapping[str, int], reached: bool
    ) -> PrefixExplanation:
        """This and what a branch assumes of a step; `places` are those of exogenous actions.

        `reached` says whether the goal holds after the step.
        """
        held = (step + 1, self.held) if reached else self.held
        if not branch.size:
            return replace(self, held=held) if reached else self
        events = sorted(branch.events, key=places.__getitem__)
        # An attempt has no place among exogenous actions, and comes before reports.
        distrusted = sorted(branch.distrusted, key=lambda action: places.get(action, -1))
        return PrefixExplanation(
            (*(Happening(step, event) for event in events), *self.events),
            (*(Happening(step, event) for event in distrusted), *self.distrusted),
            (*(_distrust(step, places.get(action)) for action in distrusted), *self.distrusts),
            (*((-step, places[event]) for event in events), *self.assumes),
            held,
        )

    def followed_by(self, suffix: Explanation, first: int) -> Explanation:
        """The whole explanation, with the history explained from step `first` on."""
        return Explanation(
            _joined(self.events, suffix.unobserved, first),
            _joined(self.distrusted, suffix.distrusted, first),
        )


Entries = Mapping[State, Sequence[PrefixExplanation]]
"""Of each state the smallest explanations that lead there, in their order."""


class Frontier:
    """The entries of a step of one history, from a known state at step 0; it advances by steps.

    Where there are more than `most` states, `limit` is lowered. `kept` explanations are kept of
    each state.
    """

    def __init__(
        self, tracker: BeliefTracker, most: int, kept: int, start: State, limit: int
    ) -> None:
        self._transitions = tracker.transitions
        events = tracker.knowledge.description.exogenous_actions
        self._places: Mapping[str, int] = {event: place for place, event in enumerate(events)}
        self._holds, self._since = tracker.holds, tracker.since
        self._most = most
        self._kept = kept
        self._branches: dict[tuple[object, ...], list[Branch] | None] = {}
        self._advancing: Iterator[Entries | int] | None = None
        held = (0, None) if self._holds(start) else None
        self.step, self.limit = 0, limit
        self.entries: Entries = {start: (PrefixExplanation(held=held),)}

    @property
    def least(self) -> int:
        """The size of the smallest explanation; one more than the limit where there is none."""
        sizes = (prefixes[0].size for prefixes in self.entries.values())
        return min(sizes, default=self.limit + 1)

    @property
    def size(self) -> int:
        """How much it keeps: explanations, and transitions that it remembers."""
        return len(self._branches) + sum(map(len, self.entries.values()))

    def told(
        self, prefixes: Sequence[PrefixExplanation]
    ) -> tuple[Sequence[PrefixExplanation], bool]:
        """Those of a state's explanations that are kept, and whether there are more."""
        return prefixes[: self._kept], len(prefixes) > self._kept

    def advance(self, record: Record, following: Record, work: int) -> int:
        """Goes on with the next step; what is left of `work`, counted in transitions.

        It goes on next time with what it has not done. Raises LimitError.
        """
        advancing, self._advancing = self._advancing, None
        if advancing is None:
            advancing = self._step(record, following)
        while work > 0:
            done = next(advancing)
            if not isinstance(done, int):
                self.step, self.entries = self.step + 1, done
                return work - _WORK_OF_A_STEP
            work -= done
        self._advancing = advancing
        return work

    def _step(self, record: Record, following: Record) -> Iterator[Entries | int]:
        """The entries of the next step, after the work of each call of the solver."""
        while True:
            found: dict[State, list[PrefixExplanation]] = {}
            complete = True
            for state, prefixes in sorted(self.entries.items(), key=lambda e: e[1][0].size):
                room = self.limit - prefixes[0].size
                if room < 0:
                    continue
                if self.step < self._since:
                    room = -1
                key = state, record.action, record.failing, record.reported, room
                if key not in self._branches:
                    yield self._look(key, state, record, room)
                branches = self._branches[key]
                if branches is None:
                    complete = False
                    break
                self._extend(found, prefixes, branches, record, following)
            if complete and len(found) <= self._most:
                yield {state: self._first(prefixes) for state, prefixes in found.items()}
                return
            self.limit -= 1

    def _look(self, key: tuple[object, ...], state: State, record: Record, room: int) -> int:
        """Looks for the branches of a state; how much work that was."""
        if len(self._branches) >= REMEMBERED:
            self._branches.clear()
        found = self._transitions.branches(
            state, record.action, record.reported, room, self._most * 4, record.failing
        )
        # Of several outcomes of the same events the order says nothing.
        self._branches[key] = found if found is None or _is_deterministic(found) else None
        return _WORK_OF_A_CALL + (self._most * 4 if found is None else len(found))

    def _extend(
        self,
        found: dict[State, list[PrefixExplanation]],
        prefixes: Sequence[PrefixExplanation],
        branches: Iterable[Branch],
        record: Record,
        following: Record,
    ) -> None:
        """Adds what the explanations of a state lead to with each of its branches."""
        true = frozenset(filter(is_positive, following.observed))
        false = frozenset(map(atom, following.observed)) - true
        for branch in branches:
            if record.attempt is not None and record.attempt[1] != branch.took_effect:
                continue
            if not (true <= branch.state and false.isdisjoint(branch.state)):
                continue
            reached = self._holds(branch.state)
            if following.goal not in (None, reached):
                continue
            size = prefixes[0].size + branch.size
            there = found.setdefault(branch.state, [])
            if there and there[0].size < size:
                continue
            if there and there[0].size > size:
                there.clear()
            there += (
                prefix.extended(branch, self.step, self._places, reached) for prefix in prefixes
            )

    def _first(self, prefixes: list[PrefixExplanation]) -> Sequence[PrefixExplanation]:
        if len(prefixes) == 1:
            return prefixes
        return sorted(prefixes, key=lambda prefix: prefix.order)[: self._kept + 1]


def _is_deterministic(branches: Sequence[Branch]) -> bool:
    return len({(branch.events, branch.distrusted) for branch in branches}) == len(branches)


def _distrust(step: int, place: int | None) -> tuple[int, ...]:
    return (_ATTEMPT, -step) if place is None else (_REPORT, step, -place)


def _joined(
    before: Sequence[Happening], after: Sequence[Happening], first: int
) -> tuple[Happening, ...]:
    return (*sorted(before), *(Happening(first + step, action) for step, action in after))
