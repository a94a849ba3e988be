"""A clock of reasoning that stands still while something is made that is then kept."""

from __future__ import annotations

import time
from collections.abc import Iterator
from contextlib import contextmanager

_stood_still = 0.0


def reasoning_clock() -> float:
    """Seconds, as `time.perf_counter`, without those spent on making what is kept.

    Controls are grounded, and spaces for searches made, once in a process, by whichever trial needs
    them first; counted in, they would make the cost of a trial depend on what was played before.
    The limit on a decision counts them (`asp.solving.time_limit`): a robot may take no longer.
    """
    return time.perf_counter() - _stood_still


@contextmanager
def standing_still() -> Iterator[None]:
    """The clock stands still inside, however often this is nested."""
    global _stood_still
    began, before = time.perf_counter(), _stood_still
    try:
        yield
    finally:
        # What was spent inside another one is part of it.
        _stood_still = before + time.perf_counter() - began
