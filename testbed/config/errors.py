"""The one error a wrong configuration gives, and the wording its lines share."""

from __future__ import annotations

import difflib
from collections.abc import Iterable, Sequence


class ConfigError(ValueError):
    """A wrong configuration: `lines` holds one line an error, each with its place."""

    def __init__(self, lines: Sequence[str]) -> None:
        super().__init__("\n".join(lines))
        self.lines = tuple(lines)


def nearest(word: str, known: Iterable[str]) -> str:
    """A suggestion: the nearest known word, or all of them where none is near."""
    choices = sorted(set(known))
    near = difflib.get_close_matches(word, choices, n=1, cutoff=0.5)
    if near:
        return f"did you mean '{near[0]}'?"
    return "known: " + ", ".join(choices) if choices else "none is known here"
