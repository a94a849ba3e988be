"""How the page writes its text."""

from __future__ import annotations


def percent(share: float) -> str:
    """A share in whole percents."""
    return f"{100 * share:.0f}%"
