"""Keep an interrupt away from where it would do harm."""

from __future__ import annotations

import signal
from collections.abc import Iterator
from contextlib import contextmanager
from multiprocessing import resource_tracker
from threading import current_thread, main_thread


@contextmanager
def interrupts_later() -> Iterator[None]:
    """Deliver an interrupt that comes in this block at its end.

    A process started in it is deaf to interrupts from its first moment. Blocking the signal does
    that; it does not spare this process, whose other threads may get it.
    """
    if current_thread() is not main_thread():
        yield
        return
    resource_tracker.ensure_running()  # its start, with that of a process, would lift the block
    missed: list[int] = []
    handler = signal.signal(signal.SIGINT, lambda number, _: missed.append(number))
    mask = signal.pthread_sigmask(signal.SIG_BLOCK, {signal.SIGINT})
    try:
        yield
    finally:
        signal.pthread_sigmask(signal.SIG_SETMASK, mask)
        signal.signal(signal.SIGINT, handler)
        if missed:
            signal.raise_signal(signal.SIGINT)
