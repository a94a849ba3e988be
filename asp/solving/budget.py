"""The budget of a decision: conflicts, sizes and expansions, which are the same everywhere.

Beside them the clock is a guard. Whatever is solved, ground or searched inside `deciding` keeps to
the limits; one decision is made at a time in a process, for robots share controls, and a control
serves one caller at a time.

And what it took, by a clock that tells apart what is prepared once and reused. Process time is that
of the whole process, every thread of the solver included: where several robots reason at once in
threads of one process, each is charged for all of them. A process per robot, which is what
`testbed run` has, keeps them apart.
"""

from __future__ import annotations

import threading
import time
from collections.abc import Hashable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from contextvars import ContextVar
from dataclasses import dataclass
from typing import NamedTuple

import clingo

OUT_OF_BUDGET = "the budget of a decision was used up"


class LimitError(RuntimeError):
    """A decision has reached one of its limits; every control stays usable."""


class BudgetError(LimitError):
    """The conflicts, ground rules or expansions of a decision were used up."""


@dataclass(frozen=True)
class Limits:
    """Bounds of a decision; None: no bound.

    `seconds` are wall-clock time, `conflicts` those of the solver in calls that take more than
    some thousand, `ground_rules` the rules of one ground program, `expansions` the applications
    of an operator to a set of states in searches.
    """

    seconds: float | None = None
    conflicts: int | None = None
    ground_rules: int | None = None
    expansions: int | None = None


class Budget:
    """What is left of the limits of a decision; `late` if its time ran out."""

    def __init__(self, limits: Limits, outer: Budget | None) -> None:
        """Inside `outer` the time began with it; everything else is counted anew."""
        self.limits = limits
        self.part = 1.0
        self.late = False
        self._outer = outer
        self._began: float = time.monotonic() if outer is None else outer._began
        self._conflicts = self._expansions = 0

    @property
    def deadline(self) -> float | None:
        """When the time runs out, by `time.monotonic`."""
        return None if self.limits.seconds is None else self._began + self.limits.seconds

    @property
    def conflicts(self) -> int | None:
        """How many conflicts may still be spent."""
        most = self.limits.conflicts
        return None if most is None else max(0, int(most * self.part) - self._conflicts)

    def check_conflicts(self) -> None:
        """Raises BudgetError where no conflicts may be spent any more."""
        if self.conflicts == 0:
            raise BudgetError(OUT_OF_BUDGET)

    def take_conflicts(self, number: int) -> None:
        """So many conflicts were spent; where that is more than there were, all are."""
        left = self.conflicts
        self._conflicts += number if left is None else min(number, left)

    def take_expansions(self, number: int) -> None:
        """So many expansions are spent. Raises LimitError."""
        self._expansions += number
        most = self.limits.expansions
        if most is not None and self._expansions > most:
            raise BudgetError(OUT_OF_BUDGET)
        self.check_time()

    def check_time(self) -> None:
        """Raises LimitError where the time has run out."""
        if self.deadline is not None and time.monotonic() > self.deadline:
            raise self.out_of_time()

    def out_of_time(self) -> LimitError:
        """What to raise where the time has run out."""
        budget: Budget | None = self
        while budget is not None:
            budget.late, budget = True, budget._outer
        return LimitError("the time for a decision ran out")


_current: ContextVar[Budget | None] = ContextVar("budget", default=None)
UNLIMITED = Limits()
_alone = threading.RLock()


@contextmanager
def deciding(limits: Limits = UNLIMITED) -> Iterator[Budget]:
    """What is done inside is one decision, or a part of the one around it, within its limits."""
    with _alone:
        budget = Budget(limits, _current.get())
        token = _current.set(budget)
        try:
            yield budget
        finally:
            _current.reset(token)


@contextmanager
def up_to(part: float) -> Iterator[None]:
    """Inside, conflicts are spent up to this part of all those of the decision."""
    budget = current()
    before, budget.part = budget.part, min(budget.part, part)
    try:
        yield
    finally:
        budget.part = before


def current() -> Budget:
    """The budget of the decision under way; outside of any, one without limits."""
    return _current.get() or Budget(UNLIMITED, None)


_RULES_BETWEEN_LOOKS = 1_000
_MARGIN = 4
_MOST_REMEMBERED = 1_000


class _Counter(clingo.Observer):
    """Counts the rules of one control, however often it is ground further."""

    def __init__(self) -> None:
        self.rules = 0

    def rule(self, choice: bool, head: Sequence[int], body: Sequence[int]) -> None:
        """One rule more. What is raised here ends the grounding."""
        del choice, head, body
        self.rules += 1
        budget = current()
        most = budget.limits.ground_rules
        if most is not None and self.rules > most:
            raise BudgetError(f"a ground program has more than {most} rules")
        if self.rules % _RULES_BETWEEN_LOOKS == 0:
            budget.check_time()


# Counting takes as long as grounding, so that programs that are known to be small are not counted:
# those of the same texts and about as many steps, where these are far below the limit.
_counted: dict[Hashable, _Counter] = {}


def count_rules(
    control: clingo.Control, texts: Sequence[str], constants: Mapping[str, int]
) -> None:
    """What is ground in the control from now on raises LimitError, and stops, at a limit."""
    limits = current().limits
    if limits.ground_rules is None and limits.seconds is None:
        return
    key = (*texts, *((name, number.bit_length()) for name, number in constants.items()))
    known = _counted.get(key)
    if known is not None and known.rules * _MARGIN <= (limits.ground_rules or 0):
        return
    if len(_counted) >= _MOST_REMEMBERED:
        _counted.clear()
    _counted[key] = counter = _Counter()
    control.register_observer(counter)


class Reading(NamedTuple):
    """Seconds: by the wall and of process time, both without preparation, and of preparation.

    `preparation_cpu` is the process time of preparation. Only differences of readings mean
    anything, and only within a thread.
    """

    wall: float = 0.0
    cpu: float = 0.0
    preparation_cpu: float = 0.0

    def since(self, earlier: Reading) -> Reading:
        """What was spent between the two: not less than nothing, as rounding would have it."""
        return Reading(*(max(0.0, now - then) for now, then in zip(self, earlier, strict=True)))


class _Prepared(threading.local):
    """What this thread has spent on preparation so far, in seconds."""

    wall = 0.0
    cpu = 0.0


_prepared = _Prepared()


def reasoning_clock() -> Reading:
    """What has been spent so far.

    Controls are grounded, problems encoded, and spaces for searches made, once per process, by
    whichever trial needs them first; counted as reasoning, they would make the cost of a trial
    depend on what was played before. The limit on a decision counts
    them: a robot may take no longer.
    """
    wall, cpu = time.perf_counter(), time.process_time()
    return Reading(wall - _prepared.wall, cpu - _prepared.cpu, _prepared.cpu)


@contextmanager
def preparation() -> Iterator[None]:
    """What is spent inside is preparation, which others can reuse; it may be nested."""
    began = reasoning_clock()
    try:
        yield
    finally:
        # What was spent inside another one is part of it.
        _prepared.wall = time.perf_counter() - began.wall
        _prepared.cpu = time.process_time() - began.cpu
