"""Caches that drop the least recently used values, bounded by weight."""

from collections import OrderedDict
from collections.abc import Callable, Hashable
from typing import Generic, TypeVar

Key = TypeVar("Key", bound=Hashable)
Value = TypeVar("Value")


class Recent(Generic[Key, Value]):
    """Keeps the values that were used last, which weigh at most so much together.

    `weight` is what they weigh. Others are made anew when they are asked for. The one used last is
    kept, whatever it weighs.

    Unlike `functools.lru_cache` over a method this has no reference to what it belongs to. A cycle
    of references keeps sessions in memory until the garbage collector comes by, which counts
    objects and knows nothing of the size of a session.
    """

    def __init__(self, most: int) -> None:
        self._most = most
        self._kept: OrderedDict[Key, tuple[Value, int]] = OrderedDict()
        self.weight = 0

    def get(self, key: Key, make: Callable[[], Value], weight: int = 1) -> Value:
        """The value of a key, made if need be."""
        if key not in self._kept:
            # Room is made first, so that there is never more of it at a time.
            while self._kept and self.weight + weight > self._most:
                self.weight -= self._kept.popitem(last=False)[1][1]
            self._kept[key] = make(), weight
            self.weight += weight
        self._kept.move_to_end(key)
        return self._kept[key][0]

    def __len__(self) -> int:
        return len(self._kept)


class Answers(Recent[Key, Value]):
    """Answers, which may be forgotten at any time, where others are what answers are found with."""

    def forget(self) -> None:
        """All answers are found anew."""
        self._kept.clear()
        self.weight = 0
