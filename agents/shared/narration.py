"""Texts for people that know their parts: told in other names and steps, never read again."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from typing import Any, TypeVar

from msgspec import Struct, structs

from asp.language import Literal

T = TypeVar("T")
_STEPS = frozenset({"step", "futile_at"})
"""The fields of messages that hold a step."""


class Step(int):
    """A step of a history, as a part of a text."""


class Narration(str):
    """A text made of words, literals and steps, which are its `parts`."""

    parts: tuple[object, ...]

    def __new__(cls, *parts: object) -> Narration:
        text = super().__new__(cls, "".join(map(str, parts)))
        text.parts = parts
        return text

    def __getnewargs__(self) -> tuple[object, ...]:  # type: ignore[override]
        return self.parts


def listed(literals: Iterable[Literal]) -> Narration:
    """The literals, with commas between them."""
    return Narration(*[part for each in literals for part in (", ", each)][1:])


def retold(
    told: T,
    literal: Callable[[Literal], Literal] = lambda same: same,
    step: Callable[[int], int] = lambda same: same,
) -> T:
    """A message, or a part of one, with other literals and other steps."""

    def change(part: Any, field: str = "") -> Any:
        match part:
            case Narration():
                return Narration(*map(change, part.parts))
            case Literal():
                return literal(part)
            case Step():
                return Step(step(part))
            case int() if field in _STEPS:
                return step(part)
            case list():
                return [change(each) for each in part]
            case Struct():
                changed = {f: change(getattr(part, f), f) for f in part.__struct_fields__}
                return structs.replace(part, **changed)
        return part

    changed: T = change(told)
    return changed
