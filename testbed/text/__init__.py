"""Text for terminals and pages: words, and lines that cannot steer what shows them."""

import os
import shutil
import sys
import unicodedata
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import TextIO

Say = Callable[[str], None]

WIDE = 150
"""Columns where output goes to no terminal and COLUMNS is not set."""
_HIDDEN = ("Cc", "Cf", "Cs", "Zl", "Zp")
"""Categories of characters that steer: control, format (also of direction), separators of lines."""


def plain(text: str, keep: str = "") -> str:
    """The text with an escape such as `\\x1b` for each character that steers what shows it.

    Characters of `keep` stay as they are.
    """
    if text.isprintable():
        return text
    return "".join(own if own in keep else _visible(own) for own in text)


def _visible(character: str) -> str:
    steers = unicodedata.category(character) in _HIDDEN
    return character.encode("unicode_escape").decode("ascii") if steers else character


def tolerant() -> None:
    """Let standard output and error take any text: what they cannot encode becomes `?`.

    One that was closed before the program began takes it, too: it goes nowhere.
    """
    sys.stdout = sys.stdout or _nowhere()
    sys.stderr = sys.stderr or _nowhere()
    for stream in (sys.stdout, sys.stderr):
        if hasattr(stream, "reconfigure"):
            stream.reconfigure(errors="replace")


def _nowhere() -> TextIO:
    return Path(os.devnull).open("w", encoding="utf-8")


def columns() -> int:
    """How wide lines may be: COLUMNS, else the terminal, else `WIDE`."""
    return shutil.get_terminal_size((WIDE, 0)).columns


class Printer:
    """Says lines on standard output as long as there is somebody to hear them.

    A reader who has enough (`| head`) is no error; where writing fails otherwise, standard error
    says so once, and what is said from then on is lost. Neither ends what is under way.
    """

    def __init__(self, quiet: bool = False) -> None:
        self._muted = quiet

    def __call__(self, line: str = "") -> None:
        """Say one line."""
        if self._muted:
            return
        try:
            print(plain(line), flush=True)
        except OSError as error:
            self._muted = True
            mute(sys.stdout.fileno())
            if not isinstance(error, BrokenPipeError):
                warn(f"standard output: {error.strerror}")


def warn(line: str) -> None:
    """Say a line on standard error, if anybody hears it."""
    try:
        print(plain(line), file=sys.stderr, flush=True)
    except OSError:
        mute(sys.stderr.fileno())


def mute(descriptor: int) -> None:
    """Let what is still to be written there go nowhere, so that no flush at the end fails."""
    nowhere = os.open(os.devnull, os.O_WRONLY)
    os.dup2(nowhere, descriptor)
    os.close(nowhere)


def counted(number: int, noun: str) -> str:
    """`1 trial`, `2 trials`: nouns whose plural ends in s."""
    return f"{number} {noun}" if number == 1 else f"{number} {noun}s"


def listed(names: Sequence[str]) -> str:
    """`a`, `a and b`, `a, b and c`."""
    return " and ".join([part for part in (", ".join(names[:-1]), *names[-1:]) if part])


def number(value: float | None) -> str:
    """A ratio with two decimals."""
    return "-" if value is None else f"{value:.2f}"


def chance(p: float | None) -> str:
    """A p-value as text."""
    if p is None:
        return "-"
    return "p < 0.001" if p < 0.001 else f"p = {p:.3f}"
