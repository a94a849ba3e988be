"""Levels have the sizes of the published table, and any other size has the same shape."""

from dataclasses import astuple
from importlib.resources import files

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from asp.domains import LEVELS, LevelSize, level_text
from asp.refinement import Refinement, load

TABLE = {  # objects by their parts, rooms, cells a room
    "L1": ({1: 1}, 2, 2),
    "L2": ({2: 2}, 3, 2),
    "L3": ({3: 3}, 4, 4),
    "L4": ({4: 4}, 5, 5),
    "L5": ({2: 8}, 5, 9),
    "L6": ({2: 8, 1: 4}, 5, 12),
    "L7": ({2: 8, 1: 4}, 5, 16),
    "L8": ({2: 16, 1: 8}, 5, 16),
}


def refinement(size: LevelSize) -> Refinement:
    coarse, fine = level_text(size.rooms, size.rows, size.columns, size.objects)
    return load(coarse, "level.al", fine, "level.fine")


def neighbours(of: Refinement, static: str) -> set[tuple[str, ...]]:
    statics = of.statics
    return {fact.arguments for fact in statics if fact.name == static}


@pytest.mark.parametrize("level", TABLE)
def test_a_published_level_has_its_size(level: str) -> None:
    objects, rooms, cells = TABLE[level]
    found = refinement(LEVELS[level])
    sorts = found.coarse_signature.sorts
    counts = [len(found.components[thing]) for thing in sorts["object"]]
    assert {parts: counts.count(parts) for parts in counts} == objects
    assert [len(found.components[room]) for room in sorts["room"]] == [cells] * rooms
    assert sorts["robot"] == ("rob1",)


@pytest.mark.parametrize(
    ("level", "doors"),
    [
        ("L1", {("room1_2", "room2_1")}),
        ("L3", {("room1_4", "room2_3"), ("room2_4", "room3_3"), ("room3_4", "room4_3")}),
        ("L4", {(f"room{n}_5", f"room{n + 1}_1") for n in range(1, 5)}),
        ("L6", {(f"room{n}_12", f"room{n + 1}_9") for n in range(1, 5)}),
        ("L8", {(f"room{n}_16", f"room{n + 1}_13") for n in range(1, 5)}),
    ],
)
def test_one_doorway_leads_from_a_last_cell_to_the_first_of_a_last_row(
    level: str, doors: set[tuple[str, str]]
) -> None:
    found = refinement(LEVELS[level])
    between = {
        (one, other)
        for one, other in neighbours(found, "fine_next_to")
        if found.wholes[one] != found.wholes[other]
    }
    assert between == doors | {(other, one) for one, other in doors}


sizes = st.builds(
    LevelSize,
    st.integers(1, 5),
    st.integers(1, 4),
    st.integers(1, 4),
    st.lists(st.tuples(st.integers(1, 3), st.integers(1, 3)), min_size=1, max_size=2).map(tuple),
)


@given(sizes)
@settings(max_examples=30)
def test_the_cells_of_a_room_are_a_grid(size: LevelSize) -> None:
    found = refinement(size)
    near = neighbours(found, "fine_next_to")
    for room in found.coarse_signature.sorts["room"]:
        spots = {c: divmod(n, size.columns) for n, c in enumerate(found.components[room])}
        for one, (row, column) in spots.items():
            for other, (row2, column2) in spots.items():
                beside = abs(row - row2) + abs(column - column2) == 1
                assert ((one, other) in near) == beside


@given(sizes)
@settings(max_examples=30)
def test_the_rooms_are_a_row(size: LevelSize) -> None:
    rooms = [f"room{n}" for n in range(1, size.rooms + 1)]
    near = neighbours(refinement(size), "next_to")
    assert near == {(a, b) for a in rooms for b in rooms if abs(int(a[4:]) - int(b[4:])) == 1}


def test_the_packaged_texts_are_level_2() -> None:
    packaged = files("asp").joinpath("domains")
    texts = tuple(
        packaged.joinpath(f"level.{kind}").read_text(encoding="utf-8") for kind in ("al", "fine")
    )
    assert level_text(*astuple(LEVELS["L2"])) == texts


@pytest.mark.parametrize(
    ("size", "message"),
    [
        ((0, 1, 1, ((1, 1),)), "rooms: 0 is too few"),
        ((2, 0, 1, ((1, 1),)), "rows: 0 is too few"),
        ((2, 1, -1, ((1, 1),)), "columns: -1 is too few"),
        ((2, 1, 1, ()), "objects: 0 is too few"),
        ((2, 1, 1, ((2, 1), (1, 0))), "objects: 1 with 0 parts cannot be"),
        ((2, 1, 1, ((2, 1), (-1, 1))), "objects: -1 with 1 parts cannot be"),
    ],
)
def test_a_size_that_is_none(
    size: tuple[int, int, int, tuple[tuple[int, int], ...]], message: str
) -> None:
    with pytest.raises(ValueError, match=message):
        level_text(*size)
