"""Text of a page with values in it."""

from __future__ import annotations

from collections.abc import Iterable
from textwrap import fill

WIDTH = 100


def paragraph(text: str) -> str:
    """The same in lines of one width, whatever the length of the values in it."""
    return fill(" ".join(text.split()), WIDTH, break_long_words=False, break_on_hyphens=False)


def document(parts: Iterable[str]) -> str:
    """Paragraphs, tables and headings, with an empty line between them."""
    return "\n\n".join(part.strip("\n") for part in parts if part) + "\n"


def times(value: float | None) -> str:
    """A ratio."""
    return "-" if value is None else f"{value:.2f}"
