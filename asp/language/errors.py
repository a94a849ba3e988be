"""The error of a bad action description."""

from __future__ import annotations

from collections.abc import Sequence


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
