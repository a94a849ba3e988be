"""What a misspelt name may have been meant to be."""

from __future__ import annotations

from collections.abc import Iterable
from difflib import get_close_matches

_LIKENESS = 0.5


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
