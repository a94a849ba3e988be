"""The conditions of a sweep: which keys take which values, and what each combination is called."""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from decimal import Decimal
from itertools import product
from math import prod
from typing import Annotated, Any

import msgspec
from pydantic import BeforeValidator, Field, model_validator
from pydantic_core import PydanticCustomError

from testbed.config.values import Name, Section

MOST_CELLS = 10_000
"""The most conditions of a sweep."""
NUMBER = r"-?(?:\d+(?:\.\d*)?|\.\d+)(?:[eE]-?\d+)?"
RANGE = re.compile(rf"({NUMBER}):({NUMBER}):({NUMBER})$")
"""`FIRST:LAST:STEP`, in decimal."""
FIXED: Mapping[str, str] = {
    **dict.fromkeys(("name", "protocol", "sweep"), "is that of the whole run"),
    **dict.fromkeys(
        ("link", "limits.answer_s", "rewards", "runner", "scheduler", "stress", "tls"),
        "changes no result",
    ),
    **dict.fromkeys(
        ("robots", "scenarios", "levels"), "is a list that is played under every condition"
    ),
    **dict.fromkeys(("baseline", "treatment"), "says what is compared, under every condition"),
    **dict.fromkeys(
        ("seed", "limit", "repeats", "draw", "level_sizes"),
        "says which trials are played, and these are the same under all conditions",
    ),
    **dict.fromkeys(
        ("domain", "refinement"), "makes another experiment, which is run and compared with this"
    ),
}
"""Keys that are not swept, and why."""


def _values(given: object) -> object:
    """A range as its numbers; anything else as it is."""
    return list(numbers_of(given)) if isinstance(given, str) else given


def numbers_of(text: str) -> Sequence[int | float]:
    """The numbers of a range, the last one included; exact in decimal, so 0:1:0.1 has 11.

    Raises PydanticCustomError for a text of another form, and for a range without an end.
    """
    found = RANGE.match(text)
    if found is None:
        told = "should be a list of values, or a range such as 0:1:0.1 (first, last, step)"
        raise PydanticCustomError("sweep", told)
    first, last, step = map(Decimal, found.groups())
    count = int((last - first) / step) + 1 if step else 0
    if not 1 <= count <= MOST_CELLS:
        told = f"has no last number, or more than {MOST_CELLS}; a range is first:last:step"
        raise PydanticCustomError("sweep", told)
    numbers = [first + number * step for number in range(count)]
    whole = all(own == own.to_integral_value() and "." not in text for own in numbers)
    return [int(own) if whole else float(own) for own in numbers]


def _groups(given: object) -> object:
    """Lists that are zipped: one group of keys, or several of them."""
    return [given] if isinstance(given, Mapping) else given


Values = Annotated[tuple[Any, ...], BeforeValidator(_values), Field(min_length=1)]
Lists = dict[Name, Values]


@dataclass(frozen=True)
class Axis:
    """What is varied together: the name of each point, with the keys that it sets."""

    name: str
    points: Mapping[str, Mapping[str, Any]]


class Sweep(Section):
    """Conditions under each of which all trials are played, from the same seeds.

    `grid`: each key takes each of its values, in every combination. `zip`: keys whose lists are
    gone through together; or several such groups. `conditions`: sets of keys that have a name.
    Of everything that is given each is combined with each. Keys are dotted; in place of a list of
    values there may be a range, `FIRST:LAST:STEP`, the last number included.
    """

    grid: Lists = Field(default_factory=dict)
    zip: Annotated[tuple[Lists, ...], BeforeValidator(_groups)] = ()
    conditions: dict[Name, dict[Name, Any]] = Field(default_factory=dict)

    @model_validator(mode="after")
    def _is_sound(self) -> Sweep:
        """Lists that are zipped are equally long, no key is varied twice, conditions are not many.

        Raises ValueError, one line.
        """
        for group in self.zip:
            lengths = {key: len(own) for key, own in group.items()}
            if len(set(lengths.values())) > 1:
                told = ", ".join(f"{key} has {n}" for key, n in lengths.items())
                raise PydanticCustomError("sweep", f"zips lists of equal length; {told} values")
        groups = [
            self.grid,
            *self.zip,
            {key: () for own in self.conditions.values() for key in own},
        ]
        keys = [key for group in groups for key in group]
        for key in keys:
            if (why := _refusal(key)) is not None:
                raise PydanticCustomError("sweep", f"cannot vary {key}, which {why}")
            if keys.count(key) > 1:
                raise PydanticCustomError("sweep", f"varies {key} twice; keep one of the two")
        if self.size > MOST_CELLS:
            told = f"has {self.size} conditions; {MOST_CELLS} are the most"
            raise PydanticCustomError("sweep", told)
        return self

    @property
    def size(self) -> int:
        """The number of conditions; 1 where nothing is swept."""
        return prod(len(own.points) for own in self.axes)

    @property
    def axes(self) -> tuple[Axis, ...]:
        """What is varied, as it was given: named conditions, zipped groups, single keys."""
        groups = [*filter(None, self.zip), *({key: own} for key, own in self.grid.items())]
        named = [Axis("condition", self.conditions)] if self.conditions else []
        return (*named, *map(_axis, groups))

    @property
    def cells(self) -> dict[str, dict[str, Any]]:
        """The keys that each condition sets, by its name; one of nothing where nothing is swept."""
        chosen = product(*(own.points.items() for own in self.axes))
        return {
            ", ".join(name for name, _ in points): {
                k: v for _, own in points for k, v in own.items()
            }
            for points in chosen
        }


def _refusal(key: str) -> str | None:
    """Why a key is not swept; a part of one that is not is neither."""
    inner = (
        why for own, why in FIXED.items() if key == own or key.startswith((f"{own}.", f"{own}["))
    )
    return next(inner, None)


def _axis(lists: Mapping[str, Sequence[Any]]) -> Axis:
    """Lists that are gone through together; a point is named by the first key, or else by all.

    Raises PydanticCustomError where not even all of them tell the points apart.
    """
    first = next(iter(lists))
    rows = [dict(zip(lists, values, strict=True)) for values in zip(*lists.values(), strict=True)]
    texts = [_named(row, [first]) for row in rows]
    if len(set(texts)) < len(rows):
        texts = [_named(row, lists) for row in rows]
    ((text, times),) = Counter(texts).most_common(1)
    if times > 1:
        raise PydanticCustomError("sweep", f"has {text} {times} times; keep one of them")
    return Axis(first, dict(zip(texts, rows, strict=True)))


def _named(row: Mapping[str, Any], keys: Iterable[str]) -> str:
    return ", ".join(f"{key}={_text(row[key])}" for key in keys)


def _text(value: object) -> str:
    return value if isinstance(value, str) else msgspec.json.encode(value, enc_hook=str).decode()
