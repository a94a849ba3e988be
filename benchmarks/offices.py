"""Offices of any size: the packaged domain's laws over other rooms, books and maps."""

import re
from collections.abc import Callable, Iterator, Mapping, Sequence
from functools import cache
from itertools import pairwise

from asp.language import read_domain

_SORT = r"^(?P<head>\s*{name}\s*=\s*)\{{[^}}]*\}}"
_MAP = re.compile(r"(?<=\nfacts\n)(?:^  next_to\(\w+, \w+\)\.\n)+", re.MULTILINE)
_SCENARIOS = re.compile(r"(?:^%[^\n]*\n)*^scenarios\n.*?(?=^[a-z]|\Z)", re.MULTILINE | re.DOTALL)
_LEAST_ROOMS = 3

Map = Callable[[Sequence[str]], Iterator[tuple[str, str]]]


@cache
def office(books: int = 2, rooms: int = 4, shape: str = "row", secure: int = 1) -> str:
    """AL_d text of an office: `asp/domains/office.al` over other sorts and another map.

    The scenarios are left out: a large office would have a hundred thousand instances of them.

    `rooms` counts all rooms, `secure` those among them that can be locked; `shape` is one of
    MAPS. office() has the rooms, books and map of the packaged domain. Raises ValueError for a
    size too small to hold the rooms that the packaged domain speaks of.
    """
    names = room_names(rooms, secure)
    text = read_domain("office")[1]
    text = _with_sort(text, "secure_room", names[rooms - secure :])
    text = _with_sort(text, "room", [names[rooms - secure - 1], *names[: rooms - secure - 1]])
    text = _with_sort(text, "book", book_names(books))
    doors = "".join(f"  next_to({one}, {other}).\n" for one, other in MAPS[shape](names))
    return _replaced(_SCENARIOS, "", _replaced(_MAP, doors, text))


def room_names(rooms: int, secure: int = 1) -> list[str]:
    """The rooms in the order of the map: offices, the kitchen, the secure rooms.

    Raises ValueError.
    """
    if secure < 1 or rooms - secure < _LEAST_ROOMS - 1:
        raise ValueError("an office has a kitchen, an office room and a secure room at least")
    offices = [f"office{number}" for number in range(1, rooms - secure)]
    libraries = ["library", *(f"library{number}" for number in range(2, secure + 1))]
    return [*offices, "kitchen", *libraries]


def book_names(books: int) -> list[str]:
    """book1, book2, ..."""
    return [f"book{number}" for number in range(1, books + 1)]


def _row(rooms: Sequence[str]) -> Iterator[tuple[str, str]]:
    yield from pairwise(rooms)


def _grid(rooms: Sequence[str]) -> Iterator[tuple[str, str]]:
    width = round(len(rooms) ** 0.5)
    for number, room in enumerate(rooms):
        if (number + 1) % width and number + 1 < len(rooms):
            yield room, rooms[number + 1]
        if number + width < len(rooms):
            yield room, rooms[number + width]


def _tree(rooms: Sequence[str]) -> Iterator[tuple[str, str]]:
    for number, room in enumerate(rooms[1:], start=1):
        yield rooms[(number - 1) // 2], room


def _hub(rooms: Sequence[str]) -> Iterator[tuple[str, str]]:
    yield from ((rooms[0], room) for room in rooms[1:])


MAPS: Mapping[str, Map] = {"row": _row, "grid": _grid, "tree": _tree, "hub": _hub}
"""Which rooms are next to each other, of rooms in the order of `room_names`."""


def _with_sort(text: str, name: str, members: Sequence[str]) -> str:
    pattern = re.compile(_SORT.format(name=name), re.MULTILINE)
    return _replaced(pattern, rf"\g<head>{{{', '.join(members)}}}", text)


def _replaced(pattern: re.Pattern[str], by: str, text: str) -> str:
    text, count = pattern.subn(by, text)
    if count != 1:
        raise ValueError(f"the packaged office has {count} places like {pattern.pattern}, not one")
    return text
