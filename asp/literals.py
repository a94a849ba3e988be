"""Ground atoms and literals as ASP text: `loc(book1,kitchen)`, `-loc(book1,kitchen)`."""

from __future__ import annotations

import re
from collections.abc import Iterable
from functools import lru_cache

_ATOM = re.compile(r"(-?)\s*([a-z_][A-Za-z0-9_]*)\s*(?:\(([^()]*)\))?\s*")


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


def normalise(text: str) -> str:
    """The literal a person wrote, without blanks. Raises ValueError if it is not one."""
    match = _ATOM.fullmatch(text.strip())
    if match is None:
        raise ValueError(f"{text!r} is not a literal such as loc(a,b) or -loc(a,b)")
    sign, functor, inner = match.groups()
    args = [part.strip() for part in inner.split(",")] if inner is not None else []
    if not all(args) and inner is not None:
        raise ValueError(f"{text!r} has an empty argument")
    return sign + ground(functor, args)
