"""Signals while a control works: handled between its calls only, so that it stays usable."""

import signal
import threading
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from types import FrameType

_SIGNALS = (signal.SIGINT, signal.SIGTERM)

Deliver = Callable[[], None]
"""Handles the signals that have come so far, as they would have been handled."""


@contextmanager
def undisturbed() -> Iterator[Deliver]:
    """Puts off the handling of signals, which must not raise inside a call that clingo makes.

    They are handled where what this gives is called, and at the end. Signals that Python does not
    handle are left alone, and so are all outside of the main thread, where Python handles none.
    """
    if threading.current_thread() is not threading.main_thread():
        yield lambda: None
        return
    handlers = {int(n): own for n in _SIGNALS if callable(own := signal.getsignal(n))}
    came: list[int] = []
    active = True

    def put_off(number: int, frame: FrameType | None) -> None:
        if active:
            came.append(number)
        else:  # an interrupt has kept this in the handler's place
            handlers[number](number, frame)

    def deliver() -> None:
        while came:
            number = came.pop(0)
            handlers[number](number, None)

    try:
        for number in handlers:
            signal.signal(number, put_off)
        yield deliver
    finally:
        active = False
        for number, own in handlers.items():
            signal.signal(number, own)
        deliver()
