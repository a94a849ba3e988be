"""A menu of numbered actions: what a person typed chooses one, or is answered by one line."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

from asp.language import Action
from testbed.play.keys import BACKSPACE, DOWN, END, ENTER, HOME, PAGE_DOWN, PAGE_UP, UP
from testbed.text import counted, plain

MOST_DIGITS = 9
MOST_LISTED = 40
"""Choices that are listed at once where there are no keys."""


@dataclass(frozen=True)
class Choice:
    """An action under its number, which is that of the environment's action space.

    `note`: why it is unlikely to take effect, "" where nothing is known against it.
    """

    number: int
    action: Action
    note: str = ""

    @property
    def line(self) -> str:
        """The choice as a line."""
        return f"{self.number:>4}  {self.action}" + (f"  ({self.note})" if self.note else "")


def chosen(text: str, choices: Sequence[Choice]) -> Choice | None:
    """The choice whose number, or action, a text is; None if it is none."""
    wanted = "".join(text.split())
    if len(wanted) <= MOST_DIGITS and wanted.isascii() and wanted.isdigit():
        return next((own for own in choices if own.number == int(wanted)), None)
    return next((own for own in choices if own.action == wanted), None)


def listing(choices: Sequence[Choice]) -> Iterator[str]:
    """The choices, one per line; of many the first ones."""
    yield from (own.line for own in choices[:MOST_LISTED])
    if len(choices) > MOST_LISTED:
        more = counted(len(choices) - MOST_LISTED, "more choice")
        yield f"      and {more}; a part of a name lists those that have it"


def answered(text: str, choices: Sequence[Choice]) -> Iterator[str]:
    """What is said to a text that chooses nothing: the choices that have it, or one line."""
    found = [own for own in choices if text.strip() and text.strip() in own.action]
    if found:
        yield from listing(found)
    else:
        shown = plain(text.strip()[:40])
        yield f"'{shown}' is not one of the choices; type a number of the list, or q to leave"


class Menu:
    """A menu with a cursor. Digits move it to the choice with that number.

    `message` is the line below the choices.
    """

    def __init__(self, choices: Sequence[Choice], height: int) -> None:
        """`height`: so many choices are shown at a time."""
        self._choices, self._height = choices, max(1, height)
        self._at, self._typed = 0, ""
        self.message = self._help()

    def press(self, key: str) -> Choice | None:
        """The choice that the key makes; None where it makes none."""
        if key == ENTER:
            return None if self._typed and self._find() is None else self._choices[self._at]
        moves = {UP: -1, DOWN: 1, PAGE_UP: -self._height, PAGE_DOWN: self._height}
        last = len(self._choices) - 1
        if key in moves:
            self._move(min(last, max(0, self._at + moves[key])))
        elif key in (HOME, END):
            self._move(0 if key == HOME else last)
        elif key == BACKSPACE:
            self._type(self._typed[:-1])
        elif key.isdigit() and len(self._typed) < MOST_DIGITS:
            self._type(self._typed + key)
        return None

    def lines(self, width: int) -> list[str]:
        """The choices around the cursor, and the message; no line is wider."""
        first = max(0, min(self._at - self._height // 2, len(self._choices) - self._height))
        shown = enumerate(self._choices[first : first + self._height], start=first)
        marked = (f"{'>' if at == self._at else ' '} {own.line}" for at, own in shown)
        return [plain(line)[: max(1, width - 1)] for line in (*marked, self.message)]

    def _move(self, at: int) -> None:
        self._at, self._typed, self.message = at, "", self._help()

    def _type(self, typed: str) -> None:
        self._typed, self.message = typed, f"number {typed}" if typed else self._help()
        found = self._find()
        if found is not None:
            self._at = self._choices.index(found)
        elif typed:
            self.message += ": not one of the choices"

    def _find(self) -> Choice | None:
        return chosen(self._typed, self._choices) if self._typed else None

    def _help(self) -> str:
        return f"{counted(len(self._choices), 'choice')}: arrows or a number, Enter; q leaves"
