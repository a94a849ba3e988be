"""Horizons that were used last, as many as are not too large together."""

from __future__ import annotations

from collections import OrderedDict
from collections.abc import Callable, Hashable

from asp.reasoning.fine_planning.horizon import Horizon


class Horizons:
    """Keeps horizons by description and length, within a bound on what they take together.

    A horizon takes its length times the size of its description: the memory of its control grows
    with that, by some 5 kB a constant and step in an office. The one used last is always kept.
    """

    def __init__(self, most: int) -> None:
        self._most = most
        self._kept: OrderedDict[tuple[Hashable, int], tuple[Horizon, int]] = OrderedDict()

    def get(
        self, description: Hashable, length: int, size: int, make: Callable[[], Horizon]
    ) -> Horizon:
        """The horizon of so many steps of a description of so many constants, made if need be."""
        key = description, length
        if key not in self._kept:
            self._shrink(self._most - length * size)
            self._kept[key] = make(), length * size
        self._kept.move_to_end(key)
        return self._kept[key][0]

    def forget(self, description: Hashable) -> None:
        """Keeps none of a description."""
        for key in [key for key in self._kept if key[0] == description]:
            del self._kept[key]

    def _shrink(self, most: int) -> None:
        """Forgets those not used for longest, until the others take so much at most."""
        while self._kept and self.size > most:
            self._kept.popitem(last=False)

    @property
    def size(self) -> int:
        """What the kept ones take together."""
        return sum(size for _, size in self._kept.values())

    def __len__(self) -> int:
        return len(self._kept)
