"""Literals as tests write them: texts, parsed."""

from collections.abc import Iterable

from asp.language import Literal


def parsed(texts: Iterable[str]) -> tuple[Literal, ...]:
    """The literals of texts, in their order."""
    return tuple(map(Literal.parse, texts))
