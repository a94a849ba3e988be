"""Goals that are drawn: literals with sorts in the place of constants."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from itertools import product

import numpy as np

from asp.language import literals as text
from testbed.world.dynamics import Dynamics


class RandomGoal:
    """Draws an instance of the patterns that does not hold yet; any, if all hold.

    Equal sorts in the patterns stand for one constant.
    """

    def __init__(
        self, world: Dynamics, patterns: Iterable[str], sorts: Mapping[str, tuple[str, ...]]
    ) -> None:
        self._world = world
        self._goals = list(_instances(tuple(patterns), sorts))

    def __call__(self, state: int, random: np.random.Generator) -> tuple[str, ...]:
        """The goal of a game that begins in the state."""
        unmet = [goal for goal in self._goals if not self._world.satisfies(state, goal)]
        options = unmet or self._goals
        return options[int(random.integers(len(options)))]


def _instances(
    patterns: tuple[str, ...], sorts: Mapping[str, tuple[str, ...]]
) -> Iterator[tuple[str, ...]]:
    names = list(dict.fromkeys(sort for p in patterns for sort in text.arguments(p)))
    for values in product(*(sorts[name] for name in names)):
        chosen = dict(zip(names, values, strict=True))
        yield tuple(_instance(pattern, chosen) for pattern in patterns)


def _instance(pattern: str, values: Mapping[str, str]) -> str:
    name = pattern.partition("(")[0]
    return text.ground(name, (values[sort] for sort in text.arguments(pattern)))
