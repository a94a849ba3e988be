"""Outcomes of actions, case by case, in terms of variables and values.

A successor state is closed under the state constraints and has, beside the direct effects and what
follows, only what was true before. All that may change is the closure K of the direct effects
under constraints whose other conditions were true before. Where nothing in K denies such a
condition, every successor has all of K and nothing else new, so that there is one at most.
"""

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass

from asp.solving import current

Literal = tuple[int, int, bool]
"""A variable, a value, and whether the variable has it."""

Body = tuple[Literal, ...]

UNDECIDED = -1
"""Stands for the value of a variable of which nothing is known."""


@dataclass(frozen=True)
class Law:
    """`head if body`."""

    head: Literal
    body: Body


MOST_BRANCHES = 50_000
"""How many combinations of values are looked at, all actions of a description together."""

_Branch = tuple[list[int], Sequence[Body]]
"""Values, as far as they are decided, and what of the hindrances is still open there."""

Case = tuple[tuple[tuple[int, int], ...], tuple[tuple[int, int], ...] | None]
"""What is true before and what is changed; None where there may be several outcomes."""


class NotEncodableError(ValueError):
    """A description with defined fluents, with several outcomes of an action, or too many cases."""


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
        branches: list[_Branch] = [([UNDECIDED] * len(self._sizes), hindrances)]
        while branches:
            current().check_time()
            self._branches += 1
            if self._branches > MOST_BRANCHES:
                raise NotEncodableError(f"actions have more than {MOST_BRANCHES} cases")
            before, left = branches.pop()
            if () in left:
                continue
            found = left[0][0][0] if left else self._outcome(effects, before)
            if isinstance(found, int):
                branches += self._decided(before, left, found)
            elif found is not None:
                yield found

    def _decided(
        self, before: Sequence[int], hindrances: Sequence[Body], variable: int
    ) -> Iterator[_Branch]:
        """The branch for each value of a variable."""
        for value, left in enumerate(by_value(hindrances, variable, self._sizes[variable])):
            values = [*before]
            values[variable] = value
            implied = self._imply(values, variable)
            if implied is not None:
                for other in implied:
                    left = by_value(left, other, self._sizes[other])[values[other]]
                yield values, left

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

    def _outcome(self, effects: Sequence[Law], before: list[int]) -> Case | int | None:
        """The outcome of an action; a variable that has to be decided first; or there is none."""
        known: dict[Literal, None] = {}
        for law in effects:
            unknown = unknown_in(law.body, before)
            if unknown is None:
                known[law.head] = None
            elif unknown >= 0:
                return unknown
        used: set[Literal] = set()
        unknown = self._close(known, used, before)
        if unknown is not None:
            return unknown
        claimed = {variable for variable, _, truth in known if truth}
        for variable, _, truth in known:
            # It loses a value which it may or may not have.
            if not truth and variable not in claimed and before[variable] == UNDECIDED:
                return variable
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

    def _judged(
        self, known: Iterable[Literal], used: Iterable[Literal], before: list[int]
    ) -> Case | int | None:
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
                        return unknown
        return pairs(before), after


def by_value(bodies: Sequence[Body], variable: int, size: int) -> list[list[Body]]:
    """Of each value of a variable, what is then left of the bodies that it does not make false."""
    found: list[list[Body]] = [[] for _ in range(size)]
    for body in bodies:
        rest = tuple(literal for literal in body if literal[0] != variable)
        values = set(range(size)) if len(rest) == len(body) else allowed(body, variable, size)
        for value in values:
            found[value].append(rest)
    return found


def allowed(body: Body, variable: int, size: int) -> set[int]:
    """The values of a variable that satisfy what a body says of it."""
    values = set(range(size))
    for about, value, truth in body:
        if about == variable:
            values &= {value} if truth else values - {value}
    return values


def pairs(before: Sequence[int]) -> tuple[tuple[int, int], ...]:
    """The variables that have a value, each with it."""
    return tuple((v, x) for v, x in enumerate(before) if x != UNDECIDED)


def truth_of(literal: Literal, state: Sequence[int]) -> bool | None:
    """Whether a literal is true; None where its variable is undecided."""
    variable, value, truth = literal
    known = state[variable]
    return None if known == UNDECIDED else (known == value) == truth


def unknown_in(body: Body, state: Sequence[int]) -> int | None:
    """None if the body is true; -1 if it is false; else a variable that decides it."""
    first: int | None = None
    for literal in body:
        truth = truth_of(literal, state)
        if truth is False:
            return -1
        if truth is None and first is None:
            first = literal[0]
    return first


def says(known: Literal, condition: Literal) -> bool:
    """Whether one literal makes the other true: also, that a variable has another value."""
    if known[:2] == condition[:2]:
        return known[2] == condition[2]
    return known[0] == condition[0] and known[2] and not condition[2]
