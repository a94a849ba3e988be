"""What is told of an abstract action, step by step: counts at the fine resolution, coarse steps."""

from __future__ import annotations

import re
from bisect import bisect_right
from collections.abc import Iterable, Iterator
from contextlib import contextmanager
from typing import Any, Literal, TypeVar

from msgspec import structs

from asp.solving import Reading, reasoning_clock
from testbed.protocol import Contradiction, Event, Explanation, FineTrace, Trace

_STEP = re.compile(r"(?<=\bstep )\d+")
_LASTING = ("abstract", "begun", "plans", "actions", "tests")

Phase = Literal["planning", "infer"]
T = TypeVar("T", Explanation, Event, Contradiction)


class Tally:
    """Numbers of a trial so far, and what is new at the present step (`FineTrace`)."""

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

    def count(self, what: Literal["plans", "actions", "tests"]) -> None:
        """One more of these."""
        self.note(**{what: getattr(self._now, what) + 1})

    def end(self, happened: bool, inferred: Iterable[str]) -> None:
        """The abstract action is over."""
        ended = self._now.abstract
        self.note(
            abstract="", begun=None, ended=ended, happened=happened, inferred=sorted(inferred)
        )

    def committed(self, literals: Iterable[str]) -> None:
        """These literals are newly taken for certain."""
        self.note(committed=[*self._now.committed, *literals])

    def spend(self, phase: Phase, spent: Reading) -> None:
        """So much was spent on a phase."""
        wall, cpu = f"{phase}_time_s", f"{phase}_cpu_s"
        before = getattr(self._now, wall), getattr(self._now, cpu)
        self.note(**{wall: before[0] + spent.wall, cpu: before[1] + spent.cpu})

    @contextmanager
    def timing(self, phase: Phase) -> Iterator[None]:
        """The time inside is of a phase."""
        began = reasoning_clock()
        try:
            yield
        finally:
            self.spend(phase, reasoning_clock().since(began))


class Calendar:
    """When each coarse step began, in steps of the environment.

    Step 0 is that of both, at which the goal is selected.
    """

    def __init__(self) -> None:
        self._began = [0]

    @property
    def step(self) -> int:
        """The present coarse step."""
        return len(self._began) - 1

    def begin(self, step: int) -> None:
        """The next coarse step begins at this step of the environment."""
        self._began.append(step)

    def coarse(self, step: int) -> int:
        """The coarse step to which a step of the environment belongs."""
        return bisect_right(self._began, step) - 1

    def own(self, step: int) -> int:
        """The step of the environment at which a coarse step began, or may begin at the soonest."""
        ahead = max(0, step - self.step)
        return self._began[step - ahead] + ahead

    def trace(self, trace: Trace) -> Trace:
        """A trace of the coarse robot with steps of the environment in it."""
        explanation = trace.explanation
        return structs.replace(
            trace,
            explanation=None if explanation is None else self._explanation(explanation),
            contradictions=list(map(self._moved, trace.contradictions)),
            alternatives=list(map(self._explanation, trace.alternatives)),
            futile_at=None if trace.futile_at is None else self.own(trace.futile_at),
            reason=_STEP.sub(lambda found: str(self.own(int(found[0]))), trace.reason),
        )

    def _explanation(self, explanation: Explanation) -> Explanation:
        return structs.replace(
            self._moved(explanation),
            unobserved=list(map(self._moved, explanation.unobserved)),
            distrusted=list(map(self._moved, explanation.distrusted)),
        )

    def _moved(self, told: T) -> T:
        return structs.replace(told, step=self.own(told.step))
