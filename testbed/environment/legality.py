"""The events that an adversary may choose from, where there are too many to try them all."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from typing import overload


class LegalEvents(Sequence[str]):
    """The candidates that pass a test, in their order; `in` tests one, iterating tests on."""

    def __init__(self, candidates: Sequence[str], legal: Callable[[str], bool]) -> None:
        self._candidates = candidates
        self._legal = legal

    def __contains__(self, event: object) -> bool:
        return event in self._candidates and self._legal(str(event))

    def __iter__(self) -> Iterator[str]:
        return filter(self._legal, self._candidates)

    def __len__(self) -> int:
        return sum(1 for _ in self)

    @overload
    def __getitem__(self, index: int) -> str: ...
    @overload
    def __getitem__(self, index: slice) -> Sequence[str]: ...
    def __getitem__(self, index: int | slice) -> str | Sequence[str]:
        return tuple(self)[index]
