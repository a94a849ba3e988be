"""A clock of reasoning that tells apart what is prepared once and reused.

Process time is that of the whole process, every thread of the solver included: where several robots
reason at once in threads of one process, each is charged for all of them. A process per robot,
which is what `testbed run` has, keeps them apart.
"""

from __future__ import annotations

import threading
import time
from collections.abc import Iterator
from contextlib import contextmanager
from typing import NamedTuple


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
    depend on what was played before. The limit on a decision (`asp.solving.budget`) counts
    them: a robot may take no longer.
    """
    wall, cpu = time.perf_counter(), time.process_time()
    return Reading(wall - _prepared.wall, cpu - _prepared.cpu, _prepared.cpu)


@contextmanager
def preparation() -> Iterator[None]:
    """What is spent inside is preparation, which others can reuse; it may be nested."""
    wall, cpu = time.perf_counter(), time.process_time()
    before = _prepared.wall, _prepared.cpu
    try:
        yield
    finally:
        # What was spent inside another one is part of it.
        _prepared.wall = before[0] + time.perf_counter() - wall
        _prepared.cpu = before[1] + time.process_time() - cpu
