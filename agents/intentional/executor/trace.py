"""The trace of an abstract action at the fine resolution, step by step."""

from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any
from typing import Literal as Choice

from msgspec import structs

from asp.solving import Reading, reasoning_clock
from testbed.protocol import FineTrace

_LASTING = ("abstract", "begun", "plans", "actions", "tests")

Phase = Choice["planning", "infer"]


class FineTraceBuilder:
    """What is told of the present step of a trial at the fine resolution (`FineTrace`)."""

    def __init__(self) -> None:
        self._now = FineTrace()

    def take(self) -> FineTrace:
        """What there is to tell of the present step; the next one begins."""
        told = self._now
        self._now = FineTrace(**{field: getattr(told, field) for field in _LASTING})
        return told

    def note(self, **told: Any) -> None:
        """Tells this of the present step."""
        self._now = structs.replace(self._now, **told)

    def add(self, field: str, more: Any = 1) -> None:
        """Tells so much, or so many, more in a field."""
        self.note(**{field: getattr(self._now, field) + more})

    def spend(self, phase: Phase, spent: Reading) -> None:
        """So much was spent on a phase."""
        self.add(f"{phase}_time_s", spent.wall)
        self.add(f"{phase}_cpu_s", spent.cpu)

    @contextmanager
    def timing(self, phase: Phase) -> Iterator[None]:
        """The time inside is of a phase."""
        began = reasoning_clock()
        try:
            yield
        finally:
            self.spend(phase, reasoning_clock().since(began))
