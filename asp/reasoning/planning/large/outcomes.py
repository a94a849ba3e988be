"""What an action leads to, case by case, in terms of variables and values.

A successor state is closed under the state constraints and has, beside the direct effects and what
follows, only what was true before. All that may change is the closure K of the direct effects
under constraints whose other conditions were true before. Where nothing in K denies such a
condition, every successor has all of K and nothing else new, so that there is one at most.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass

from asp.reasoning.planning.large.variables import (
    UNDECIDED,
    Body,
    Law,
    Literal,
    by_value,
    pairs,
    says,
    truth_of,
    unknown_in,
)
from asp.solving import current

MOST_BRANCHES = 50_000
"""How many combinations of values are looked at, all actions of a description together."""

Case = tuple[tuple[tuple[int, int], ...], tuple[tuple[int, int], ...] | None]
"""What is true before and what is changed; None where there may be several outcomes."""


class NotEncodableError(ValueError):
    """A description with defined fluents, with several outcomes of an action, or too many cases."""


@dataclass(frozen=True)
class _Split:
    """The outcome depends on a variable of which nothing is known."""

    variable: int


@dataclass(frozen=True)
class _Branch:
    """Values, as far as they are decided, and what of the hindrances is still open there."""

    before: list[int]
    hindrances: Sequence[Body]


class Laws:
    """State constraints; those that speak of one variable only are left out by the caller."""

    def __init__(self, constraints: Iterable[Law], sizes: Sequence[int]) -> None:
        """`sizes` are the numbers of values of each variable."""
        self._constraints = tuple(constraints)
        self._sizes = sizes
        self._branches = 0
        self._claiming: dict[tuple[int, int], list[Law]] = {}
        self._denying: dict[int, list[Law]] = {}
        self._concluding: dict[int, list[Law]] = {}
        for law in self._constraints:
            self._concluding.setdefault(law.head[0], []).append(law)
            for variable, value, truth in law.body:
                if truth:
                    self._claiming.setdefault((variable, value), []).append(law)
                else:
                    self._denying.setdefault(variable, []).append(law)

    def hold(self, state: Sequence[int]) -> bool:
        """Whether a complete state is closed under the constraints."""
        return all(
            truth_of(law.head, state) or unknown_in(law.body, state) is not None
            for law in self._constraints
        )

    def cases(self, effects: Sequence[Law], hindrances: Sequence[Body]) -> Iterator[Case]:
        """The cases in which an action has a successor state.

        Raises NotEncodableError where these are too many, and LimitError.
        """
        branches = [_Branch([UNDECIDED] * len(self._sizes), hindrances)]
        while branches:
            current().check_time()
            self._branches += 1
            if self._branches > MOST_BRANCHES:
                raise NotEncodableError(f"actions have more than {MOST_BRANCHES} cases")
            branch = branches.pop()
            if () in branch.hindrances:
                continue
            if branch.hindrances:
                branches += self._decided(branch, branch.hindrances[0][0][0])
                continue
            found = self._outcome(effects, branch.before)
            if isinstance(found, _Split):
                branches += self._decided(branch, found.variable)
            elif found is not None:
                yield found

    def _decided(self, branch: _Branch, variable: int) -> Iterator[_Branch]:
        """The branch for each value of a variable."""
        open_bodies = by_value(branch.hindrances, variable, self._sizes[variable])
        for value, hindrances in enumerate(open_bodies):
            before = branch.before.copy()
            before[variable] = value
            implied = self._imply(before, variable)
            if implied is not None:
                for other in implied:
                    hindrances = by_value(hindrances, other, self._sizes[other])[before[other]]
                yield _Branch(before, hindrances)

    def _imply(self, before: list[int], variable: int) -> list[int] | None:
        """Adds the values that constraints imply, of which variables; None: no such state."""
        changed = [variable]
        for about in changed:  # grows while it is read
            for law in self._touched(about, before[about]):
                if unknown_in(law.body, before) is not None:
                    continue
                truth = truth_of(law.head, before)
                if truth is False:
                    return None
                if truth is None and law.head[2]:
                    before[law.head[0]] = law.head[1]
                    changed.append(law.head[0])
        return changed[1:]

    def _touched(self, variable: int, value: int) -> Iterable[Law]:
        """The constraints with a condition that may have come true with a value."""
        return (*self._claiming.get((variable, value), ()), *self._denying.get(variable, ()))

    def _outcome(self, effects: Sequence[Law], before: list[int]) -> Case | _Split | None:
        known: dict[Literal, None] = {}
        for law in effects:
            unknown = unknown_in(law.body, before)
            if unknown is None:
                known[law.head] = None
            elif unknown >= 0:
                return _Split(unknown)
        used: set[Literal] = set()
        unknown = self._close(known, used, before)
        if unknown is None:
            unknown = self._undecided_denial(known, before)
        if unknown is not None:
            return _Split(unknown)
        return self._judged(known, used, before)

    def _close(
        self, known: dict[Literal, None], used: set[Literal], before: list[int]
    ) -> int | None:
        """Adds to `known` what follows, and to `used` what of `before` it follows from.

        Tells a variable that has to be decided first, if there is one.
        """
        waiting = list(known)
        for literal in waiting:  # grows while it is read
            for law in self._touched(*literal[:2]):
                if not any(says(literal, condition) for condition in law.body):
                    continue
                rest = tuple(c for c in law.body if not any(says(k, c) for k in known))
                unknown = unknown_in(rest, before)
                if unknown is None:
                    used.update(rest)
                    if law.head not in known:
                        known[law.head] = None
                        waiting.append(law.head)
                elif unknown >= 0:
                    return unknown
        return None

    def _undecided_denial(self, known: Iterable[Literal], before: list[int]) -> int | None:
        """A variable that loses a value which it may or may not have."""
        claimed = {variable for variable, _, truth in known if truth}
        denied = (variable for variable, _, truth in known if not truth)
        return next((v for v in denied if v not in claimed and before[v] == UNDECIDED), None)

    def _judged(
        self, known: Iterable[Literal], used: Iterable[Literal], before: list[int]
    ) -> Case | _Split | None:
        """The outcome if it is one state, none, or several that cannot be told apart here."""
        if any(says(literal, (v, x, not truth)) for literal in known for v, x, truth in used):
            return pairs(before), None
        following = before.copy()
        for variable, value, truth in known:
            if truth:
                following[variable] = value
            elif following[variable] == value:
                # Of two values the other one, of several the last, which is none of them.
                following[variable] = self._sizes[variable] - 1
        if any(truth_of(literal, following) is False for literal in known):
            return None
        after = tuple((v, x) for v, x in pairs(following) if before[v] != x)
        for variable, _ in after:
            for law in self._concluding.get(variable, ()):
                if truth_of(law.head, following) is False:
                    unknown = unknown_in(law.body, following)
                    if unknown is None:
                        return None
                    if unknown >= 0:
                        return _Split(unknown)
        return pairs(before), after
