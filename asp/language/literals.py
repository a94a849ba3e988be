"""Ground atoms and literals as ASP text: `loc(book1,kitchen)`, `-loc(book1,kitchen)`."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from functools import lru_cache


def complement(literal: str) -> str:
    """The same atom with the other sign."""
    return literal[1:] if literal.startswith("-") else "-" + literal


def atom(literal: str) -> str:
    """The literal without its sign."""
    return literal.removeprefix("-")


def is_positive(literal: str) -> bool:
    return not literal.startswith("-")


def name(literal: str) -> str:
    """The fluent's or action's name: `loc` of `-loc(book1,kitchen)`."""
    return atom(literal).partition("(")[0]


@lru_cache(maxsize=100_000)
def arguments(literal: str) -> tuple[str, ...]:
    """The argument constants: `("book1", "kitchen")` of `-loc(book1,kitchen)`."""
    inner = literal.partition("(")[2].removesuffix(")")
    return tuple(inner.split(",")) if inner else ()


def ground(name: str, args: Iterable[str]) -> str:
    """The atom of a name and its argument constants."""
    inside = ",".join(args)
    return f"{name}({inside})" if inside else name


def renamed(literal: str, names: Mapping[str, str]) -> str:
    """The literal or action with other names for its constants; one without keeps its own."""
    constants = (names.get(constant, constant) for constant in arguments(literal))
    return ("" if is_positive(literal) else "-") + ground(name(literal), constants)
