"""The states that a history may have led to, each with the smallest explanations that lead there.

Whatever is explained later is explained by one of these and by events after it: of explanations
that lead to the same state only the smallest can belong to a smallest one of the whole, and of
those that are equally small only the first in the order of `order.lp` to the first one. The states
that take more than `limit` events are left out, so that a frontier knows all explanations of a
history with at most so many. Where the same events may lead to several states, the order does not
say to which, and nothing is folded.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence

from asp.language import atom, is_positive
from asp.reasoning.diagnosis.encoding import Record
from asp.reasoning.diagnosis.long_histories.prefix_explanations import Prefix
from asp.reasoning.successors import Branch, Transitions
from asp.solving import State

REMEMBERED = 4_000
_WORK_OF_A_STEP, _WORK_OF_A_CALL = 16, 2

Entries = Mapping[State, Sequence[Prefix]]
"""Of each state the smallest explanations that lead there, in their order."""


class Frontier:
    """The entries of a step of one history; it advances step by step.

    Where there are more than `most` states, `limit` is lowered. `kept` explanations are kept of
    each state.
    """

    def __init__(
        self,
        transitions: Transitions,
        events: Sequence[str],
        holds: Callable[[State], bool],
        since: int,
        most: int,
        kept: int,
    ) -> None:
        """`events` are the exogenous actions as declared, `since` as in `Past`."""
        self._transitions = transitions
        self._places = {event: place for place, event in enumerate(events)}
        self._holds = holds
        self._since = since
        self._most = most
        self._kept = kept
        self._branches: dict[tuple[object, ...], list[Branch] | None] = {}
        self._advancing: Iterator[Entries | int] | None = None

    def begin(self, start: State, limit: int) -> None:
        """Starts at step 0, in a state that is known."""
        held = (0, None) if self._holds(start) else None
        self.step, self.limit = 0, limit
        self.entries: Entries = {start: (Prefix(held=held),)}
        self._advancing = None

    @property
    def least(self) -> int:
        """The size of the smallest explanation; one more than the limit where there is none."""
        sizes = (prefixes[0].size for prefixes in self.entries.values())
        return min(sizes, default=self.limit + 1)

    @property
    def size(self) -> int:
        """How much it keeps: explanations, and transitions that it remembers."""
        return len(self._branches) + sum(map(len, self.entries.values()))

    def told(self, prefixes: Sequence[Prefix]) -> tuple[Sequence[Prefix], bool]:
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
            found: dict[State, list[Prefix]] = {}
            complete = True
            for state, prefixes in sorted(self.entries.items(), key=lambda e: e[1][0].size):
                room = self.limit - prefixes[0].size
                if room < 0:
                    continue
                key = self._key(state, record, room)
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

    def _key(self, state: State, record: Record, room: int) -> tuple[object, ...]:
        attempt = None if record.attempt is None else record.attempt[0]
        return state, attempt, record.failing, record.reported, self._room(room)

    def _room(self, room: int) -> int:
        return -1 if self.step < self._since else room

    def _look(self, key: tuple[object, ...], state: State, record: Record, room: int) -> int:
        """Looks for the branches of a state; how much work that was."""
        if len(self._branches) >= REMEMBERED:
            self._branches.clear()
        attempt = None if record.attempt is None else record.attempt[0]
        found = self._transitions.branches(
            state, attempt, record.reported, self._room(room), self._most * 4, record.failing
        )
        # Of several outcomes of the same events the order says nothing.
        self._branches[key] = found if found is None or _is_deterministic(found) else None
        return _WORK_OF_A_CALL + (self._most * 4 if found is None else len(found))

    def _extend(
        self,
        found: dict[State, list[Prefix]],
        prefixes: Sequence[Prefix],
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

    def _first(self, prefixes: list[Prefix]) -> Sequence[Prefix]:
        if len(prefixes) == 1:
            return prefixes
        return sorted(prefixes, key=lambda prefix: prefix.order)[: self._kept + 1]


def _is_deterministic(branches: Sequence[Branch]) -> bool:
    return len({(branch.events, branch.distrusted) for branch in branches}) == len(branches)
