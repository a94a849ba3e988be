"""What an action leads to, case by case, in terms of variables and values.

A successor state is closed under the state constraints and has, beside the direct effects and what
follows, only what was true before. All that may change is the closure K of the direct effects
under constraints whose other conditions were true before. Where nothing in K denies such a
condition, every successor has all of K and nothing else new, so that there is one at most.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass

Literal = tuple[int, int, bool]
"""A variable, a value, and whether the variable has it."""

Body = tuple[Literal, ...]
Case = tuple[tuple[tuple[int, int], ...], tuple[tuple[int, int], ...] | None]
"""What is true before and what is changed; None where there may be several outcomes."""

_UNDECIDED = -1


@dataclass(frozen=True)
class Law:
    """`head if body`."""

    head: Literal
    body: Body


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
            _truth(law.head, state) or _unknown(law.body, state) is not None
            for law in self._constraints
        )

    def cases(self, effects: Sequence[Law], hindrances: Sequence[Body]) -> Iterator[Case]:
        """The cases in which an action has a successor state."""
        branches = [_Branch([_UNDECIDED] * len(self._sizes), hindrances)]
        while branches:
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
        open_bodies = _by_value(branch.hindrances, variable, self._sizes[variable])
        for value, hindrances in enumerate(open_bodies):
            before = branch.before.copy()
            before[variable] = value
            implied = self._imply(before, variable)
            if implied is not None:
                for other in implied:
                    hindrances = _by_value(hindrances, other, self._sizes[other])[before[other]]
                yield _Branch(before, hindrances)

    def _imply(self, before: list[int], variable: int) -> list[int] | None:
        """Adds the values that constraints imply, of which variables; None: no such state."""
        changed = [variable]
        for about in changed:  # grows while it is read
            for law in self._touched(about, before[about]):
                if _unknown(law.body, before) is not None:
                    continue
                truth = _truth(law.head, before)
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
            unknown = _unknown(law.body, before)
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
                if not any(_says(literal, condition) for condition in law.body):
                    continue
                rest = tuple(c for c in law.body if not any(_says(k, c) for k in known))
                unknown = _unknown(rest, before)
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
        return next((v for v in denied if v not in claimed and before[v] == _UNDECIDED), None)

    def _judged(
        self, known: Iterable[Literal], used: Iterable[Literal], before: list[int]
    ) -> Case | _Split | None:
        """The outcome if it is one state, none, or several that cannot be told apart here."""
        if any(_says(literal, (v, x, not truth)) for literal in known for v, x, truth in used):
            return _pairs(before), None
        following = before.copy()
        for variable, value, truth in known:
            if truth:
                following[variable] = value
            elif following[variable] == value:
                # Of two values the other one, of several the last, which is none of them.
                following[variable] = self._sizes[variable] - 1
        if any(_truth(literal, following) is False for literal in known):
            return None
        after = tuple((v, x) for v, x in _pairs(following) if before[v] != x)
        for variable, _ in after:
            for law in self._concluding.get(variable, ()):
                if _truth(law.head, following) is False:
                    unknown = _unknown(law.body, following)
                    if unknown is None:
                        return None
                    if unknown >= 0:
                        return _Split(unknown)
        return _pairs(before), after


def _by_value(bodies: Sequence[Body], variable: int, size: int) -> list[list[Body]]:
    """Of each value of a variable, what is then left of the bodies that it does not make false."""
    found: list[list[Body]] = [[] for _ in range(size)]
    for body in bodies:
        rest = tuple(literal for literal in body if literal[0] != variable)
        values = set(range(size)) if len(rest) == len(body) else _values(body, variable, size)
        for value in values:
            found[value].append(rest)
    return found


def _values(body: Body, variable: int, size: int) -> set[int]:
    """The values of a variable that satisfy what a body says of it."""
    values = set(range(size))
    for about, value, truth in body:
        if about == variable:
            values &= {value} if truth else values - {value}
    return values


def _pairs(before: Sequence[int]) -> tuple[tuple[int, int], ...]:
    return tuple((v, x) for v, x in enumerate(before) if x != _UNDECIDED)


def _truth(literal: Literal, state: Sequence[int]) -> bool | None:
    variable, value, truth = literal
    known = state[variable]
    return None if known == _UNDECIDED else (known == value) == truth


def _unknown(body: Body, state: Sequence[int]) -> int | None:
    """None if the body is true; -1 if it is false; else a variable that decides it."""
    first: int | None = None
    for literal in body:
        truth = _truth(literal, state)
        if truth is False:
            return -1
        if truth is None and first is None:
            first = literal[0]
    return first


def _says(known: Literal, condition: Literal) -> bool:
    """Whether one literal makes the other true: also, that a variable has another value."""
    if known[:2] == condition[:2]:
        return known[2] == condition[2]
    return known[0] == condition[0] and known[2] and not condition[2]
