"""Words that tables, reports and the command line share."""

from __future__ import annotations


def counted(number: int, noun: str) -> str:
    """`1 trial`, `2 trials`: nouns whose plural ends in s."""
    return f"{number} {noun}" if number == 1 else f"{number} {noun}s"


def in_words(name: str) -> str:
    """A name of the record as text: `false_finish` is `false finish`."""
    return name.replace("_", " ")
