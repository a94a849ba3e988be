"""Offices of any size have the laws of the packaged one."""

import pytest

from asp.language import load_description, parse_description
from benchmarks.offices import MAPS, office
from testbed.world import world_of


def test_the_office_of_the_packaged_size_is_the_packaged_office() -> None:
    packaged, made = load_description("office"), parse_description(office(), "office.al")
    for part in ("sorts", "statics", "inertial", "agent_actions", "exogenous_actions", "causal"):
        assert getattr(made, part) == getattr(packaged, part)
    for part in ("constraints", "executability", "sees", "shows", "costs", "initially"):
        assert getattr(made, part) == getattr(packaged, part)
    assert made.triggers == ()


@pytest.mark.parametrize("shape", MAPS)
@pytest.mark.parametrize("rooms", [3, 4, 7, 12])
def test_every_room_can_be_reached(shape: str, rooms: int) -> None:
    description = parse_description(office(1, rooms, shape), "office.al")
    assert len(description.sorts["room"]) == rooms
    world = world_of(description)
    seen = [world.state(["loc(rob1,library)", "loc(book1,kitchen)"])]
    for state in seen:
        moves = [a for a in world.agent_actions if a.startswith("move(")]
        after = [world.successor(state, [a]) for a in moves if world.executable(state, [a])]
        seen += [state for state in dict.fromkeys(after) if state not in seen]
    assert len(seen) == rooms


def test_secure_rooms_can_be_locked_and_others_cannot() -> None:
    description = parse_description(office(2, 6, "tree", secure=3), "office.al")
    locks = [fluent for fluent in description.fluents if fluent.startswith("locked(")]
    assert locks == ["locked(library)", "locked(library2)", "locked(library3)"]


@pytest.mark.parametrize(("rooms", "secure"), [(2, 1), (4, 0), (4, 3)])
def test_an_office_too_small_is_refused(rooms: int, secure: int) -> None:
    with pytest.raises(ValueError, match="an office has a kitchen"):
        office(1, rooms, secure=secure)
