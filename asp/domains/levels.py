"""The complexity levels of the evaluation (P 4), and offices of any other size, as texts.

A level is a coarse description and the text of its refinement: rooms in a row, each a grid of
cells, one doorway between neighbours, objects with parts. The laws are those of the packaged
office without what is said of rooms that can be locked.
"""

import re
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import lru_cache
from importlib.resources import files
from itertools import pairwise

from asp.language import MOST_TEXTS


@dataclass(frozen=True)
class LevelSize:
    """Rooms in a row, rows and columns of cells a room, and how many objects have how many parts.

    Raises ValueError for a size without rooms, cells, objects or parts.
    """

    rooms: int
    rows: int
    columns: int
    objects: tuple[tuple[int, int], ...]

    def __post_init__(self) -> None:
        numbers = {"rooms": self.rooms, "rows": self.rows, "columns": self.columns}
        numbers["objects"] = sum(count for count, _ in self.objects)
        for name, number in numbers.items():
            if number < 1:
                raise ValueError(f"{name}: {number} is too few; at least 1")
        for count, parts in self.objects:
            if count < 0 or parts < 1:
                raise ValueError(f"objects: {count} with {parts} parts cannot be; at least 1 part")


LEVELS: Mapping[str, LevelSize] = {
    "L1": LevelSize(2, 1, 2, ((1, 1),)),
    "L2": LevelSize(3, 1, 2, ((2, 2),)),
    "L3": LevelSize(4, 2, 2, ((3, 3),)),
    "L4": LevelSize(5, 1, 5, ((4, 4),)),
    "L5": LevelSize(5, 3, 3, ((8, 2),)),
    "L6": LevelSize(5, 3, 4, ((8, 2), (4, 1))),
    "L7": LevelSize(5, 4, 4, ((8, 2), (4, 1))),
    "L8": LevelSize(5, 4, 4, ((16, 2), (8, 1))),
}
"""The published levels L1 to L8."""


@lru_cache(maxsize=MOST_TEXTS)
def level_text(
    rooms: int, rows: int, columns: int, objects: tuple[tuple[int, int], ...]
) -> tuple[str, str]:
    """The coarse AL_d text of a level, and the text of its refinement. Raises ValueError."""
    size = LevelSize(rooms, rows, columns, objects)
    names = [f"room{number}" for number in range(1, size.rooms + 1)]
    cells = {room: _numbered(room, size.rows * size.columns) for room in names}
    counts = [parts for count, parts in size.objects for _ in range(count)]
    things = {f"object{n}": _numbered(f"object{n}", p) for n, p in enumerate(counts, start=1)}
    coarse = _with_sort(_with_sort(_packaged("level.al"), "room", names), "object", [*things])
    wholes = (f"{whole} = {{{', '.join(parts)}}}." for whole, parts in (cells | things).items())
    fine = _with_section(_packaged("level.fine"), "components", wholes)
    return (
        _with_section(coarse, "facts", (f"next_to({a}, {b})." for a, b in pairwise(names))),
        _with_section(fine, "facts", (f"fine_next_to({a}, {b})." for a, b in _ways(size, cells))),
    )


def _numbered(whole: str, count: int) -> list[str]:
    return [f"{whole}_{number}" for number in range(1, count + 1)]


def _ways(size: LevelSize, cells: Mapping[str, Sequence[str]]) -> Iterator[tuple[str, str]]:
    """The doorways, and the neighbouring cells of each room, row by row.

    A doorway leads from the last cell of a room's last row to the first of the next room's.
    """
    for one, other in pairwise(cells.values()):
        yield one[-1], other[-size.columns]
    for room in cells.values():
        for number, cell in enumerate(room):
            if (number + 1) % size.columns:
                yield cell, room[number + 1]
            if number + size.columns < len(room):
                yield cell, room[number + size.columns]


def _with_sort(text: str, name: str, members: Sequence[str]) -> str:
    return _replaced(
        rf"(?<=^  ){name}( *)= {{[^}}]*}}", rf"{name}\1= {{{', '.join(members)}}}", text
    )


def _with_section(text: str, name: str, statements: Iterable[str]) -> str:
    lines = "".join(f"  {statement}\n" for statement in statements)
    return _replaced(rf"(?<=^{name}\n)(?:^  [^\n]+\n)*", lines, text)


def _replaced(pattern: str, by: str, text: str) -> str:
    changed, count = re.subn(pattern, by, text, flags=re.MULTILINE)
    assert count == 1, f"the packaged level has {count} places like {pattern}"
    return changed


def _packaged(name: str) -> str:
    return files("asp").joinpath("domains", name).read_text(encoding="utf-8")
