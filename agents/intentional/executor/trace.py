"""What is counted and told of the fine resolution, step by step (`FineTrace`)."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from contextlib import contextmanager

from msgspec import structs

from asp.solving import Reading, reasoning_clock
from testbed.protocol import FineTrace


class Tally:
    """Numbers of a trial so far, and what is new at the present step."""

    def __init__(self) -> None:
        self._now = FineTrace()

    def take(self) -> FineTrace:
        """What there is to tell of the present step; the next one begins."""
        told, now = self._now, self._now
        self._now = FineTrace(
            abstract=now.abstract,
            begun=now.begun,
            plans=now.plans,
            actions=now.actions,
            tests=now.tests,
        )
        return told

    def begin(self, abstract: str, step: int, zoomed: Iterable[str]) -> None:
        """An abstract action begins."""
        self._now = structs.replace(self._now, abstract=abstract, begun=step, zoomed=sorted(zoomed))

    def end(self, happened: bool, inferred: Iterable[str]) -> None:
        """The abstract action is over."""
        now = self._now
        self._now = structs.replace(
            now,
            abstract="",
            begun=None,
            ended=now.abstract,
            happened=happened,
            inferred=sorted(inferred),
        )

    def plan(self, actions: Iterable[str]) -> None:
        self._now = structs.replace(self._now, plan=list(actions), plans=self._now.plans + 1)

    def action(self) -> None:
        self._now = structs.replace(self._now, actions=self._now.actions + 1)

    def test(self) -> None:
        self._now = structs.replace(self._now, tests=self._now.tests + 1)

    def committed(self, literals: Iterable[str]) -> None:
        self._now = structs.replace(self._now, committed=[*self._now.committed, *literals])

    def failed(self, what: str) -> None:
        self._now = structs.replace(self._now, failed=what)

    def planned(self, spent: Reading) -> None:
        """So much was spent on planning, and on beginning with the trial, which counts as such."""
        now = self._now
        self._now = structs.replace(
            now,
            planning_time_s=now.planning_time_s + spent.wall,
            planning_cpu_s=now.planning_cpu_s + spent.cpu,
        )

    def _inferred(self, spent: Reading) -> None:
        now = self._now
        self._now = structs.replace(
            now,
            infer_time_s=now.infer_time_s + spent.wall,
            infer_cpu_s=now.infer_cpu_s + spent.cpu,
        )

    @contextmanager
    def planning(self) -> Iterator[None]:
        """The time inside is one of planning."""
        began = reasoning_clock()
        try:
            yield
        finally:
            self.planned(reasoning_clock().since(began))

    @contextmanager
    def inferring(self) -> Iterator[None]:
        """The time inside is one of inference."""
        began = reasoning_clock()
        try:
            yield
        finally:
            self._inferred(reasoning_clock().since(began))
