"""Signals while a control works: handled between its calls only, so that it stays usable."""

from __future__ import annotations

import signal
import threading
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from types import FrameType
from typing import Any

_SIGNALS = (signal.SIGINT, signal.SIGTERM)

Deliver = Callable[[], None]
"""Handles the signals that have come so far, as they would have been handled."""


class _PutOff:
    """Takes the place of handlers, and hands on to them once it is over."""

    def __init__(self, handlers: Mapping[int, Callable[[int, FrameType | None], Any]]) -> None:
        self.active = True
        self._handlers = handlers
        self._came: list[int] = []

    def handle(self, number: int, frame: FrameType | None) -> None:
        """Where an interrupt kept this in place for longer it does what the handler does."""
        if self.active:
            self._came.append(number)
        else:
            self._handlers[number](number, frame)

    def deliver(self) -> None:
        while self._came:
            number = self._came.pop(0)
            self._handlers[number](number, None)


@contextmanager
def undisturbed() -> Iterator[Deliver]:
    """Puts off the handling of signals, which must not raise inside a call that clingo makes.

    They are handled where what this gives is called, and at the end. Signals that Python does not
    handle are left alone, and so are all outside of the main thread, where Python handles none.
    """
    if threading.current_thread() is not threading.main_thread():
        yield lambda: None
        return
    found = {number: signal.getsignal(number) for number in _SIGNALS}
    handlers = {int(number): own for number, own in found.items() if callable(own)}
    put_off = _PutOff(handlers)
    try:
        for number in handlers:
            signal.signal(number, put_off.handle)
        yield put_off.deliver
    finally:
        put_off.active = False
        for number, own in handlers.items():
            signal.signal(number, own)
        put_off.deliver()
