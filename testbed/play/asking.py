"""How a person is asked: by keys on a terminal, by lines elsewhere."""

import os
import shutil
import sys
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from io import StringIO, TextIOWrapper
from typing import Protocol, TextIO

from asp.language import Action
from testbed.play.keys import CLOSED, Keys
from testbed.play.menu import Choice, Menu, answered, chosen, listing
from testbed.text import Say

MOST_TYPED = 1_000
"""Characters of a line; what comes after them is passed over."""
TALLEST = 12
"""Choices that are shown at a time."""
LEAVE = "q"


class Quit(BaseException):  # it is no error, and nothing on the way may take it for one
    """The person leaves the game before its end."""


class Asker(Protocol):
    """Asks a person to choose."""

    def ask(self, choices: Sequence[Choice]) -> Action:
        """The action of one of the choices. Raises Quit."""


class ByLines:
    """Lists the choices, and reads lines until one chooses."""

    def __init__(self, source: TextIO, say: Say) -> None:
        self._source, self._say = source, say

    def ask(self, choices: Sequence[Choice]) -> Action:
        """As `Asker.ask`."""
        for line in listing(choices):
            self._say(line)
        while True:
            text = self._line()
            if (own := chosen(text, choices)) is not None:
                self._say(f"chosen: {own.action}")
                return own.action
            for line in answered(text, choices):
                self._say(line)

    def _line(self) -> str:
        """The next line, or its beginning. Raises Quit for `q`, and where there are no more."""
        self._say("number, or q to leave:")
        text = rest = self._source.readline(MOST_TYPED)
        while rest and not rest.endswith("\n"):
            rest = self._source.readline(MOST_TYPED)
        if not text or text.strip() == LEAVE:
            raise Quit
        return text


class ByKeys:
    """A menu on a terminal, drawn in its place with each key."""

    def __init__(self, keys: Keys, screen: TextIO) -> None:
        self._keys, self._screen = keys, screen

    def ask(self, choices: Sequence[Choice]) -> Action:
        """As `Asker.ask`."""
        width, height = shutil.get_terminal_size()
        menu, drawn = Menu(choices, min(TALLEST, height - 2)), 0
        while True:
            drawn = self._draw(menu.lines(width), drawn)
            key = self._keys.read()
            if key in (LEAVE, CLOSED):
                raise Quit
            own = menu.press(key)
            if own is not None:
                self._draw([f"chosen: {own.action}"[: width - 1]], drawn)
                return own.action

    def _draw(self, lines: Sequence[str], over: int) -> int:
        """Draw lines in the place of as many as there were before; their number."""
        up = f"\x1b[{over}A" if over else ""
        self._screen.write(f"{up}\x1b[J" + "".join(f"{line}\n" for line in lines))
        self._screen.flush()
        return len(lines)


@contextmanager
def asker(say: Say) -> Iterator[Asker]:
    """What asks the person at standard input: by keys where both ends are a terminal."""
    source = sys.stdin or StringIO()  # it may have been closed before the program began
    ends = source.isatty() and sys.stdout.isatty()
    if ends and os.environ.get("TERM", "dumb") != "dumb":
        with Keys(source.fileno()) as keys:
            yield ByKeys(keys, sys.stdout)
        return
    if isinstance(source, TextIOWrapper):
        source.reconfigure(errors="replace")
    yield ByLines(source, say)
