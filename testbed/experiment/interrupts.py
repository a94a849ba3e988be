"""Signals that end a run early: SIGINT, SIGTERM and SIGHUP, and how a run ends then."""

import os
import select
import signal
import sys
import time
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from multiprocessing import active_children, resource_tracker
from multiprocessing.process import BaseProcess
from threading import Lock, Thread, current_thread, main_thread
from types import FrameType

from testbed.text import mute

SIGNALS = (signal.SIGINT, signal.SIGTERM, signal.SIGHUP)
"""What ends a run early; for the driver to handle, where all of a group get one."""
INTERRUPTED = 130
ENDING_S = 60.0
HURRY_S = 2.0
SAME_S = 0.5
"""Interrupts so close to the first are the same one: `timeout` sends two, a held key many."""
AGAIN, AGAIN_S = 255, 0.1
"""Tells the guard that an interrupt was lost, and how often it is sent until one arrives."""


@contextmanager
def stoppable(hint: str, quiet: bool = False) -> Iterator[None]:
    """Let the first signal that comes in this block raise KeyboardInterrupt; those after it do not.

    It is answered at once, whatever this process is busy with. Where it comes in a destructor, or
    in another callback of which Python loses what is raised, it is raised again. Where the block
    does not end within `ENDING_S`, or within `HURRY_S` of another interrupt, the process ends, its
    children first, with `hint` as its last line. Signals that are ignored when the block begins
    stay so (`nohup`).
    """
    if current_thread() is not main_thread():
        yield
        return
    guard = _Guard(hint, quiet)
    mine = [number for number in SIGNALS if signal.getsignal(number) is not signal.SIG_IGN]
    handlers = {number: signal.signal(number, guard.stop) for number in mine}
    before = signal.set_wakeup_fd(guard.woken, warn_on_full_buffer=False)
    guard.start()
    hook, sys.unraisablehook = sys.unraisablehook, guard.ignored
    try:
        try:
            yield
        finally:
            guard.settle()
    finally:
        sys.unraisablehook = hook
        signal.set_wakeup_fd(before)
        for number, handler in handlers.items():
            signal.signal(number, handler)
        guard.end()


class _Guard(Thread):
    """Hears of signals also while the main thread cannot, and bounds how long an ending takes."""

    def __init__(self, hint: str, quiet: bool) -> None:
        super().__init__(daemon=True)
        self._hint, self._quiet = hint, quiet
        self._stopped = self._lost = False
        self._number, self._sending = signal.SIGINT, Lock()
        self._told_before = sys.unraisablehook
        self._pipe, self.woken = os.pipe()
        os.set_blocking(self.woken, False)

    def stop(self, number: int, _: FrameType | None) -> None:
        """Handle a signal in the main thread."""
        if number == signal.SIGHUP:
            _leave_terminal()
        if not self._stopped:
            self._number, self._stopped, self._lost = signal.Signals(number), True, False
            raise KeyboardInterrupt

    def ignored(self, unraisable: "sys.UnraisableHookArgs") -> None:
        """Have an interrupt sent again that Python has lost; other exceptions are told as before.

        What is raised here would be lost, too: only the last statement lets `stop` raise.
        """
        is_mine = issubclass(unraisable.exc_type, KeyboardInterrupt) and self._stopped
        if not is_mine or current_thread() is not main_thread():
            self._told_before(unraisable)
            return
        self._lost = True
        os.write(self.woken, bytes([AGAIN]))
        self._stopped = False

    def settle(self) -> None:
        """Send nothing from now on."""
        with self._sending:
            self._stopped, self._lost = self._stopped or self._lost, False

    def _send_again(self) -> bool:
        """Send the lost interrupt; False: it has arrived."""
        with self._sending:
            if self._lost:
                signal.pthread_kill(main_thread().ident or 0, self._number)
            return self._lost

    def run(self) -> None:
        """Wait for signals, then for the end."""
        first = deadline = again = float("inf")
        while True:
            until = min(deadline, again)
            left = max(0.0, until - time.monotonic()) if until < float("inf") else None
            is_told = select.select([self._pipe], [], [], left)[0]
            now = time.monotonic()
            if not is_told:
                if deadline <= now:
                    _end(self._hint)
                # One that is sent again is the first: it is no other interrupt.
                first, again = now, now + AGAIN_S if self._send_again() else float("inf")
                continue
            for number in os.read(self._pipe, 1024):
                if number == 0:
                    return
                if number == AGAIN:
                    again = now
                elif number in SIGNALS and first > now:
                    first, deadline = now, now + ENDING_S
                    if not self._quiet:
                        _write("stopping...")
                elif number == signal.SIGINT and now > first + SAME_S:
                    deadline = min(deadline, now + HURRY_S)

    def end(self) -> None:
        """The block is over."""
        os.set_blocking(self.woken, True)
        os.write(self.woken, b"\0")
        self.join()
        os.close(self.woken)
        os.close(self._pipe)


def _write(line: str) -> None:
    """A line of its own on standard error, past whatever the main thread is writing there."""
    lines = f"\n{line}\n" if os.isatty(2) else f"{line}\n"
    with suppress(OSError):
        os.write(2, lines.encode(errors="replace"))


def _end(hint: str) -> None:
    for child in active_children():
        kill(child)
    show_cursor = "\x1b[?25h" if os.isatty(2) else ""
    _write(show_cursor + hint)
    os._exit(INTERRUPTED)


def _leave_terminal() -> None:
    """Write nowhere from now on where the terminal is gone: what is left to do needs none."""
    for stream in (sys.stdout, sys.stderr):
        try:
            os.write(stream.fileno(), b"")
        except (OSError, ValueError):
            with suppress(OSError, ValueError):
                mute(stream.fileno())


@contextmanager
def interrupts_later() -> Iterator[None]:
    """Deliver a signal that comes in this block at its end.

    A process started in it is deaf to them from its first moment. Blocking the signal does
    that; it does not spare this process, whose other threads may get it.
    """
    if current_thread() is main_thread():
        resource_tracker.ensure_running()  # its start, with that of a process, would lift the block
    with uninterrupted():
        yield


@contextmanager
def uninterrupted() -> Iterator[None]:
    """The same for a block in which no process is started."""
    if current_thread() is not main_thread():
        yield
        return
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
            handler = handlers[signal.Signals(missed[0])]
            if callable(handler):  # not by the signal again: the guard has heard of it already
                handler(missed[0], None)
            else:
                signal.raise_signal(missed[0])


def kill(process: BaseProcess) -> None:
    """Kill a process that was started, and where it leads a group, all of that."""
    assert process.pid is not None
    with suppress(ProcessLookupError, PermissionError):
        os.killpg(process.pid, signal.SIGKILL)
    process.kill()
