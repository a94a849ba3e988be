"""The keys of a terminal, one at a time."""

import os
import re
import select
import termios
import tty
from types import TracebackType
from typing import Self

UP, DOWN, PAGE_UP, PAGE_DOWN, HOME, END = "up", "down", "page up", "page down", "home", "end"
ENTER, BACKSPACE, CLOSED = "enter", "backspace", "closed"
"""Keys that are no character; `CLOSED`: there will be no more of them."""
_CONTROL = {
    b"\r": ENTER,
    b"\n": ENTER,
    b"\x7f": BACKSPACE,
    b"\x08": BACKSPACE,
    b"\x04": CLOSED,  # Ctrl-D
}
_SEQUENCE = {
    b"A": UP,
    b"B": DOWN,
    b"H": HOME,
    b"F": END,
    b"1~": HOME,
    b"4~": END,
    b"5~": PAGE_UP,
    b"6~": PAGE_DOWN,
}
"""What follows `ESC [`, or `ESC O`."""
_KEY = re.compile(rb"\x1b[\[O]([0-9;]*[A-Za-z~])|\x1b|[^\x1b]", re.DOTALL)
_TORN = re.compile(rb"\x1b(?:[\[O][0-9;]*)?\Z")
TOGETHER_S = 0.05
"""Within this time the rest of a sequence comes."""


class Keys:
    """Reads keys of a terminal within a block, in which it neither echoes nor waits for lines.

    Ctrl-C interrupts as ever.
    """

    def __init__(self, descriptor: int) -> None:
        self._descriptor, self._waiting = descriptor, b""

    def __enter__(self) -> Self:
        self._before = termios.tcgetattr(self._descriptor)
        tty.setcbreak(self._descriptor)
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        at: TracebackType | None,
    ) -> None:
        termios.tcsetattr(self._descriptor, termios.TCSADRAIN, self._before)

    def read(self) -> str:
        """The next key: one of those above, or a character of ASCII; others are passed over."""
        while True:
            if not self._waiting:
                self._waiting = os.read(self._descriptor, 1024)
            if not self._waiting:
                return CLOSED
            while _TORN.search(self._waiting) and self._more():
                pass
            key = _KEY.match(self._waiting)
            assert key is not None
            self._waiting = self._waiting[key.end() :]
            if name := _SEQUENCE.get(key[1]) if key[1] else _named(key[0]):
                return name

    def _more(self) -> bool:
        """Read what is there, if anything comes."""
        if not select.select([self._descriptor], [], [], TOGETHER_S)[0]:
            return False
        more = os.read(self._descriptor, 1024)
        self._waiting += more
        return bool(more)


def _named(byte: bytes) -> str | None:
    """The key of a byte; None of one that is no key."""
    printable = byte.decode() if byte.isascii() and byte.decode().isprintable() else None
    return _CONTROL.get(byte, printable)
