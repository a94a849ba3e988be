"""The mistakes in an action description, and what a misspelt name may have been meant to be."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from difflib import get_close_matches

from asp.language import syntax

_LIKENESS = 0.5


class SourceError(ValueError):
    """One mistake in an AL_d text, with its place.

    `str()` gives `file:line:column: message`. When several mistakes were found in one text, the
    first is raised and `all` holds every one of them in the order of the source.
    """

    def __init__(self, file: str, line: int, column: int, message: str) -> None:
        super().__init__(f"{file}:{line}:{column}: {message}")
        self.file = file
        self.line = line
        self.column = column
        self.message = message
        self.all: Sequence[SourceError] = (self,)


class Problems(list[SourceError]):
    """The mistakes found so far in one text.

    `failed` are the declarations whose names cannot be what they were meant to be: what uses
    the names that were meant is right.
    """

    def __init__(self, file: str) -> None:
        super().__init__()
        self.file = file
        self.failed: list[syntax.Declaration] = []

    def report(self, place: syntax.Place, message: str) -> None:
        self.append(SourceError(self.file, place.line, place.column, message))

    def raise_first(self) -> None:
        """Raises the first mistake in the order of the source, which then knows all of them."""
        if self:
            ordered = sorted(self, key=lambda error: (error.line, error.column))
            ordered[0].all = tuple(ordered)
            raise ordered[0]


def nearest(word: str, known: Iterable[str]) -> str | None:
    """The known word that is most like one, if any is like it at all."""
    return next(iter(get_close_matches(word, sorted(set(known)), n=1, cutoff=_LIKENESS)), None)


def suggestion(word: str, known: Iterable[str]) -> str:
    """The end of a line about an unknown word: the nearest known one, else all that are known."""
    choices = sorted(set(known))
    near = nearest(word, choices)
    if near is not None:
        return f"did you mean '{near}'?"
    return "known: " + ", ".join(choices) if choices else "none is known here"
