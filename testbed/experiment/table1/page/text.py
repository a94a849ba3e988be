"""How the page writes its text."""

from __future__ import annotations

from textwrap import fill

WIDTH = 100
"""Columns of a line."""


def paragraph(text: str) -> str:
    """A paragraph in lines."""
    return fill(text, WIDTH, break_long_words=False, break_on_hyphens=False)


def percent(share: float) -> str:
    """A share in whole percents."""
    return f"{100 * share:.0f}%"
