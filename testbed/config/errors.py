"""The one error a wrong configuration gives."""

from __future__ import annotations

from collections.abc import Sequence


class ConfigError(ValueError):
    """A wrong configuration: `lines` holds one line an error, each with its place."""

    def __init__(self, lines: Sequence[str]) -> None:
        super().__init__("\n".join(lines))
        self.lines = tuple(lines)
