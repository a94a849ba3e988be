"""What ends a run early: an interrupt or a SIGTERM, kept away from where it would do harm."""

from __future__ import annotations

import signal
from collections.abc import Iterator
from contextlib import contextmanager
from multiprocessing import resource_tracker
from threading import current_thread, main_thread
from types import FrameType

SIGNALS = (signal.SIGINT, signal.SIGTERM)


@contextmanager
def terminable() -> Iterator[None]:
    """Let the first SIGTERM that comes in this block raise KeyboardInterrupt, as SIGINT does.

    Those after it are passed over: `timeout` sends two, and the ending is to be finished.
    """
    if current_thread() is not main_thread():
        yield
        return
    handler = signal.signal(signal.SIGTERM, _terminate)
    try:
        yield
    finally:
        signal.signal(signal.SIGTERM, handler)


def _terminate(number: int, _: FrameType | None) -> None:
    signal.signal(number, signal.SIG_IGN)
    raise KeyboardInterrupt


@contextmanager
def interrupts_later() -> Iterator[None]:
    """Deliver an interrupt or a SIGTERM that comes in this block at its end.

    A process started in it is deaf to them from its first moment. Blocking the signal does
    that; it does not spare this process, whose other threads may get it.
    """
    if current_thread() is not main_thread():
        yield
        return
    resource_tracker.ensure_running()  # its start, with that of a process, would lift the block
    missed: list[int] = []
    handlers = {own: signal.signal(own, lambda n, _: missed.append(n)) for own in SIGNALS}
    mask = signal.pthread_sigmask(signal.SIG_BLOCK, SIGNALS)
    try:
        yield
    finally:
        signal.pthread_sigmask(signal.SIG_SETMASK, mask)
        for number, handler in handlers.items():
            signal.signal(number, handler)
        if missed:
            signal.raise_signal(missed[0])
