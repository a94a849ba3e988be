"""What was used last, and no more of it than so many."""

from __future__ import annotations

from collections import OrderedDict
from collections.abc import Callable, Hashable
from typing import Generic, TypeVar

Key = TypeVar("Key", bound=Hashable)
Value = TypeVar("Value")


class Recent(Generic[Key, Value]):
    """Keeps the `most` values that were used last; others are made anew when they are asked for.

    These are no answers, which may be forgotten at any time, but what answers are found with.
    """

    def __init__(self, most: int) -> None:
        self._most = most
        self._kept: OrderedDict[Key, Value] = OrderedDict()

    def get(self, key: Key, make: Callable[[], Value]) -> Value:
        """The value of a key, made if need be."""
        if key not in self._kept:
            # Room is made first, so that there are never more of them at a time.
            while len(self._kept) >= self._most:
                self._kept.popitem(last=False)
            self._kept[key] = make()
        self._kept.move_to_end(key)
        return self._kept[key]

    def __len__(self) -> int:
        return len(self._kept)


class Answers(Recent[Key, Value]):
    """The answers that were asked for last, which may be forgotten at any time.

    Unlike `functools.lru_cache` over a method it has no reference to what it belongs to. A cycle of
    references keeps controls in memory until the garbage collector comes by, which counts objects
    and knows nothing of the size of a control.
    """

    def forget(self) -> None:
        """All answers are found anew."""
        self._kept.clear()
