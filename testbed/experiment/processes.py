"""How a process that plays trials is started and killed."""

from __future__ import annotations

import os
import signal
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from multiprocessing import resource_tracker
from multiprocessing.process import BaseProcess
from threading import current_thread, main_thread

SIGNALS = (signal.SIGINT, signal.SIGTERM, signal.SIGHUP)
"""What ends a run early; for the driver to handle, where all of a group get one."""
SAFE_PATH = "PYTHONSAFEPATH"


def kill(process: BaseProcess) -> None:
    """Kill a process that was started, and where it leads a group, all of that."""
    assert process.pid is not None
    with suppress(ProcessLookupError, PermissionError):
        os.killpg(process.pid, signal.SIGKILL)
    process.kill()


@contextmanager
def safe_path() -> Iterator[None]:
    """Let a Python that is started in this block import nothing from the working directory."""
    before = os.environ.get(SAFE_PATH)
    os.environ[SAFE_PATH] = "1"
    try:
        yield
    finally:
        if before is None:
            del os.environ[SAFE_PATH]
        else:
            os.environ[SAFE_PATH] = before


@contextmanager
def interrupts_later() -> Iterator[None]:
    """Deliver a signal that comes in this block at its end.

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
            _deliver(missed[0], handlers[signal.Signals(missed[0])])


def _deliver(number: int, handler: Callable[..., object] | int | None) -> None:
    """Not by the signal again, where that can be helped: the guard has heard of it already."""
    if callable(handler):
        handler(number, None)
    else:
        signal.raise_signal(number)
