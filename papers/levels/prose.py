"""Text of a page with values in it."""

from __future__ import annotations

from collections.abc import Iterable


def document(parts: Iterable[str]) -> str:
    """Paragraphs, tables and headings, with an empty line between them."""
    return "\n\n".join(part.strip("\n") for part in parts if part) + "\n"


def times(value: float | None) -> str:
    """A ratio."""
    return "-" if value is None else f"{value:.2f}"
