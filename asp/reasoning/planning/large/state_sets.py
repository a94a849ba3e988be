"""Sets of states as bits, and the images of whole sets under operators.

The variables that most operators ask for make the *place* of a state; the other variables number
the states of one place, so that a set of states is one integer a place. An operator then leads
from place to place, by masking and shifting all states at once.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from itertools import product
from math import prod

from asp.language import Action
from asp.reasoning.planning.large.operators import Operator

StateSet = Mapping[int, int]
"""Of each place that has some of the states, these as bits."""

MOST_BITS = 2**17


@dataclass(frozen=True)
class Move:
    """What an operator does with the states of one place: mask, shift to the left, go."""

    action: Action
    to: int
    mask: int
    shift: int


class Space:
    """The states of an encoding, with the operators that change them."""

    def __init__(self, sizes: Sequence[int], operators: Iterable[Operator]) -> None:
        """`sizes` are the numbers of values of the variables."""
        changing = [operator for operator in operators if operator.after]
        outer, inner = _arranged(sizes, changing)
        self._sizes = sizes
        self._outer = _Numbering(sizes, outer)
        self._inner = _Numbering(sizes, inner)
        self._masks: dict[tuple[tuple[int, int], ...], int] = {(): (1 << self._inner.count) - 1}
        self.moves: dict[int, list[Move]] = {}
        for operator in changing:
            self._add(operator)

    def states(self, conditions: Iterable[tuple[int, int, bool]]) -> dict[int, int]:
        """The states that satisfy conditions: variable, value, whether it has this value."""
        allowed: dict[int, set[int]] = {}
        for variable, value, truth in conditions:
            values = allowed.setdefault(variable, set(range(self._sizes[variable])))
            values &= {value} if truth else values - {value}
        inner = self._masks[()]
        for variable in self._inner.strides:
            if variable in allowed:
                inner &= self._any(variable, allowed[variable])
        places = self._outer.numbers(
            {v: values for v, values in allowed.items() if v in self._outer.strides}
        )
        return dict.fromkeys(places, inner) if inner else {}

    def _any(self, variable: int, values: Iterable[int]) -> int:
        found = 0
        for value in values:
            found |= self._mask(((variable, value),))
        return found

    def _add(self, operator: Operator) -> None:
        before = dict(operator.before)
        free = [v for v, _ in operator.after if v not in before]
        for values in product(*(range(self._sizes[v]) for v in free)):
            now = {**before, **dict(zip(free, values, strict=True))}
            mask = self._mask(tuple((v, x) for v, x in now.items() if v in self._inner.strides))
            shift = self._inner.difference(now, operator.after)
            step = self._outer.difference(now, operator.after)
            fixed = {v: {x} for v, x in now.items() if v in self._outer.strides}
            for place in self._outer.numbers(fixed):
                self.moves.setdefault(place, []).append(
                    Move(operator.action, place + step, mask, shift)
                )

    def _mask(self, values: tuple[tuple[int, int], ...]) -> int:
        """The states of a place in which variables have these values."""
        if values not in self._masks:
            *others, last = values
            mask = self._inner.mask(*last)
            self._masks[values] = mask & self._mask(tuple(others)) if others else mask
        return self._masks[values]


class _Numbering:
    """Numbers of the combinations of values of some variables."""

    def __init__(self, sizes: Sequence[int], variables: Sequence[int]) -> None:
        self.strides: dict[int, int] = {}
        self._sizes = sizes
        self.count = 1
        for variable in variables:
            self.strides[variable] = self.count
            self.count *= sizes[variable]

    def numbers(self, allowed: Mapping[int, Iterable[int]]) -> Iterator[int]:
        """The numbers of the combinations of allowed values; of other variables any."""
        choices = [
            [value * stride for value in allowed.get(variable, range(self._sizes[variable]))]
            for variable, stride in self.strides.items()
        ]
        return map(sum, product(*choices))

    def difference(self, before: Mapping[int, int], after: Iterable[tuple[int, int]]) -> int:
        """By how much the number grows when values change."""
        return sum(
            (value - before[variable]) * self.strides[variable]
            for variable, value in after
            if variable in self.strides
        )

    def mask(self, variable: int, value: int) -> int:
        """The combinations in which a variable has a value, as bits."""
        stride = self.strides[variable]
        period = stride * self._sizes[variable]
        every = ((1 << self.count) - 1) // ((1 << period) - 1)
        return ((((1 << stride) - 1) << (value * stride)) * every) if every else 0


def _arranged(sizes: Sequence[int], operators: Sequence[Operator]) -> tuple[list[int], list[int]]:
    """The variables that make the place of a state, and the others."""
    asked = dict.fromkeys(range(len(sizes)), 0)
    for operator in operators:
        for variable, _ in operator.before:
            asked[variable] += 1
    order = sorted(asked, key=lambda variable: -asked[variable])
    outer = 0
    while outer < len(order) and (
        2 * asked[order[outer]] > len(operators)
        or prod(sizes[v] for v in order[outer:]) > MOST_BITS
    ):
        outer += 1
    return order[:outer], order[outer:]
