"""Ground fluents, actions and literals: text that has its parts, `-loc(book1,kitchen)`."""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping
from functools import lru_cache
from typing import TypeAlias

_MOST_KEPT = 100_000
"""Of the literals last made, which are not made a second time."""
_NAME = r"_*[a-z]\w*"
_FORM = re.compile(rf"(-?)({_NAME})(?:\(((?:{_NAME}|\d+)(?:,(?:{_NAME}|\d+))*)\))?", re.ASCII)


class Literal(str):
    """A ground literal: a name with constants, positive or negative; a fluent, an action.

    It is the text that ASP reads, without blanks, and compares, sorts and hashes as that. It is
    made of its parts (`Literal.of`), or where text comes in (`Literal.parse`); it does not change.

    Attributes: `name` (`loc` of `-loc(book1,kitchen)`), `arguments` (`("book1", "kitchen")`), and
    `is_positive`.
    """

    __slots__ = ("arguments", "is_positive", "name")

    name: str
    arguments: tuple[str, ...]
    is_positive: bool

    def __new__(
        cls, name: str, arguments: tuple[str, ...] = (), is_positive: bool = True
    ) -> Literal:
        inside = f"({','.join(arguments)})" if arguments else ""
        literal = super().__new__(cls, f"{'' if is_positive else '-'}{name}{inside}")
        set_part = object.__setattr__
        set_part(literal, "name", name)
        set_part(literal, "arguments", arguments)
        set_part(literal, "is_positive", is_positive)
        return literal

    @staticmethod
    def of(name: str, arguments: Iterable[str] = (), is_positive: bool = True) -> Literal:
        """The literal with these parts."""
        return _made(name, tuple(arguments), is_positive)

    @staticmethod
    def parse(text: str) -> Literal:
        """The literal with this text. Raises ValueError where the text is that of none."""
        return text if isinstance(text, Literal) else _parsed(text)

    @property
    def atom(self) -> Literal:
        """The literal without its sign."""
        return self if self.is_positive else self.complement

    @property
    def complement(self) -> Literal:
        """The same atom with the other sign."""
        return _made(self.name, self.arguments, not self.is_positive)

    def renamed(self, names: Mapping[str, str]) -> Literal:
        """The literal with other names for its constants; one without keeps its own."""
        return _made(
            self.name, tuple([names.get(each, each) for each in self.arguments]), self.is_positive
        )

    def __setattr__(self, name: str, value: object) -> None:
        raise AttributeError(f"a literal does not change: {name!r} cannot be set")

    def __delattr__(self, name: str) -> None:
        raise AttributeError(f"a literal does not change: {name!r} cannot be deleted")

    def __reduce__(self) -> tuple[object, ...]:
        return Literal.of, (self.name, self.arguments, self.is_positive)


Fluent: TypeAlias = Literal
"""A positive literal whose name is that of a fluent."""
Action: TypeAlias = Literal
"""A positive literal whose name is that of an action, one of the domain's or of a robot's own."""


@lru_cache(maxsize=_MOST_KEPT)
def _made(name: str, arguments: tuple[str, ...], is_positive: bool) -> Literal:
    return Literal(name, arguments, is_positive)


@lru_cache(maxsize=_MOST_KEPT)
def _parsed(text: str) -> Literal:
    found = _FORM.fullmatch(text)
    if found is None:
        shown = repr(text if len(text) < 80 else f"{text[:77]}...")
        raise ValueError(f"{shown} is not a ground literal")
    sign, name, inside = found.groups()
    return _made(name, tuple(inside.split(",")) if inside else (), not sign)
