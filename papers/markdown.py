"""Tables and paragraphs of text in Markdown."""

from collections.abc import Iterable, Sequence
from textwrap import fill

WIDTH = 100
"""Columns of a line of a paragraph."""


def paragraph(text: str) -> str:
    """The same in lines of one width, whatever the length of the values in it."""
    return fill(" ".join(text.split()), WIDTH, break_long_words=False, break_on_hyphens=False)


def markdown(columns: Sequence[str], rows: Iterable[Sequence[str]]) -> str:
    """A table: the first column to the left, the others to the right."""
    marks = ["---", *("---:" for _ in columns[1:])]
    return "\n".join(_line(cells) for cells in (columns, marks, *rows))


def _line(cells: Sequence[str]) -> str:
    return "| " + " | ".join(cells) + " |"
