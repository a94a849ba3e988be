"""Texts for people that know their parts: told in other names and steps, never read again."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from functools import partial
from typing import Any, TypeVar, cast

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
    field: str = "",
) -> T:
    """A message, or a part of one that stands in a field, with other literals and other steps."""
    # A recursive function in this one would keep itself in memory, and all that `step` knows.
    again = partial(retold, literal=literal, step=step)
    part: Any = told
    match part:
        case Narration():
            part = Narration(*map(again, part.parts))
        case Literal():
            part = literal(part)
        case Step():
            part = Step(step(part))
        case int() if field in _STEPS:
            part = step(part)
        case list():
            part = [*map(again, part)]
        case Struct():
            changed = {f: again(getattr(part, f), field=f) for f in part.__struct_fields__}
            part = structs.replace(part, **changed)
    return cast(T, part)
