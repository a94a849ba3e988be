"""What a person is shown: everything that is true, and nothing that is not."""

import re

import numpy as np
import pytest

from asp import load_description, parse_description
from asp.domains import level_text
from asp.language import Literal, read_domain
from asp.refinement import load
from testbed.environment import Core, Rules, fine_core
from testbed.environment.rendering import (
    MODES,
    Image,
    Scene,
    Window,
    draw_picture,
    draw_svg,
    draw_text,
    render,
    scene,
)
from testbed.protocol import FINISH
from testbed.world import world_of

WORLD = world_of(load_description("office"))
OFFICE = read_domain("office")[1]
IN_KITCHEN = ("loc(rob1,kitchen)", "in_hand(rob1,book1)", "loc(book2,office2)")
TOWER = """
sorts
  block = {a, b}.
  robot = {arm}.
fluents
  inertial on(block, block).
  inertial dusty(block).
actions
  agent polish(robot, block).
laws
  polish(arm, B) causes -dusty(B).
sees
  arm sees dusty(B).
"""

QUAYS = """
sorts
  quay = {east, west}.
  robot = {tug}.
statics
  canal(quay, quay).
fluents
  inertial moored(robot, quay).
  inertial swept(quay).
actions
  agent sweep(robot, quay).
facts
  canal(east, west).
laws
  sweep(R, Q) causes swept(Q).
  -moored(R, Q2) if moored(R, Q), Q != Q2.
sees
  tug sees swept(Q).
"""


def scene_of(core: Core) -> Scene:
    return scene(core.world, core.situation, core.robot)


def office(*literals: str) -> Core:
    core = Core(WORLD, Rules(goal=("loc(book1,library)",), goal_feedback=False), ())
    core.reset(0, literals or IN_KITCHEN)
    return core


def picture(core: Core) -> Image:
    return draw_picture(scene_of(core))


def test_the_rooms_stand_in_the_order_of_a_walk_through_them() -> None:
    walk = [place.name for place in scene_of(office()).places]
    assert walk == ["office1", "office2", "kitchen", "library"]


def test_the_scene_says_where_everything_is() -> None:
    rooms = {place.name: place for place in scene_of(office()).places}
    assert rooms["kitchen"].robots == {"rob1": ("book1",)}
    assert rooms["kitchen"].things == ()
    assert rooms["office2"].things == ("book2",)
    assert rooms["office1"].things == () == tuple(rooms["office1"].robots)
    assert rooms["library"].marks == {"locked": False}
    assert rooms["library"].next_to == {"kitchen"}


def test_the_scene_says_what_just_happened() -> None:
    core = office()
    assert (scene_of(core).robot, scene_of(core).adversary) == ("", "")
    core.advance(Literal.parse("move(rob1,office1)"), Literal.parse("exo_lock(library)"))
    shown = scene_of(core)
    assert (shown.robot, shown.adversary) == ("move(rob1,office1) failed", "exo_lock(library)")
    core.advance(FINISH)
    assert scene_of(core).outcome == "false_finish"


def test_every_initial_state_shows_each_thing_once() -> None:
    core = office()
    for state in WORLD.initial_states():
        core.reset(0, WORLD.literals(state))
        places = scene_of(core).places
        lying = [thing for place in places for thing in place.things]
        held = [thing for place in places for things in place.robots.values() for thing in things]
        assert sorted(lying + held) == ["book1", "book2"]
        assert [robot for place in places for robot in place.robots] == ["rob1"]


def test_the_text_shows_it() -> None:
    core = office()
    core.advance(Literal.parse("move(rob1,library)"), Literal.parse("exo_lock(library)"))
    lines = draw_text(scene_of(core)).splitlines()
    assert len({len(line) for line in lines[:-1]}) == 1
    cells = [
        [c.strip() for c in line.strip("|").replace(" = ", " | ").split(" | ")] for line in lines
    ]
    assert cells[1] == ["office1", "office2", "kitchen", "library (locked)"]
    assert cells[2] == ["", "book2", "", "[rob1] holds book1"]
    assert "step 2" in lines[-1]
    assert "move(rob1,library) beside exo_lock(library)" in lines[-1]


def test_the_picture_tells_apart_what_differs() -> None:
    pictures = [
        picture(office(*literals))
        for literals in (
            IN_KITCHEN,
            (*IN_KITCHEN, "locked(library)"),
            ("loc(rob1,kitchen)", "loc(book1,kitchen)", "loc(book2,office2)"),
            ("loc(rob1,kitchen)", "in_hand(rob1,book2)", "loc(book1,office2)"),
            ("loc(rob1,office1)", "in_hand(rob1,book1)", "loc(book2,office2)"),
        )
    ]
    for image in pictures:
        assert (image.shape, image.dtype) == (pictures[0].shape, np.uint8)
        assert image.std() > 10  # not one colour
    assert len({image.tobytes() for image in pictures}) == len(pictures)
    assert np.array_equal(pictures[0], picture(office()))


def test_a_domain_without_places_is_shown_as_well() -> None:
    world = world_of(parse_description(TOWER))
    core = Core(world, Rules(goal=()), ())
    core.reset(0, ["on(a,b)", "dusty(a)"])
    shown = scene_of(core)
    assert shown == Scene(1, (), ("on(a,b)", "dusty(a)"), "", "", "")
    assert "on(a,b)" in draw_text(shown)
    assert draw_picture(shown).ndim == 3


def test_a_mark_is_one_shape_filled_or_hollow_and_shuts_nothing() -> None:
    core = Core(world_of(parse_description(QUAYS)), Rules(goal=()), ())
    shapes, pictures = [], []
    for literals in (["moored(tug,west)"], ["moored(tug,west)", "swept(east)"]):
        core.reset(0, literals)
        shown = scene_of(core)
        assert {name for place in shown.places for name in place.marks} == {"swept"}
        shapes.append(re.findall(r'<path d="([^"]*)"', draw_svg(shown)))
        pictures.append(draw_picture(shown))
    assert len(shapes[0]) > 2
    assert shapes[0] == shapes[1]
    differs = np.argwhere((pictures[0] != pictures[1]).any(axis=2))
    left, right = differs[:, 1].min(), differs[:, 1].max()
    middle = pictures[0].shape[1] / 2
    assert right < middle - 8 or left > middle + 8  # in one of two places, not in the wall


@pytest.mark.parametrize("mode", [*MODES, None])
def test_no_mode_needs_a_screen(mode: str | None, capsys: pytest.CaptureFixture[str]) -> None:
    shown = render(office(), mode, Window("office"))
    assert (shown is None) is (mode in ("human", None))
    assert ("kitchen" in capsys.readouterr().out) is (mode == "human")


def level(*literals: str) -> Core:
    coarse, fine = level_text(2, 2, 2, ((2, 2),))
    core = fine_core(load(coarse, "level.al", fine, "level.fine"), Rules(goal=()))
    core.reset(0, literals)
    return core


IN_HAND = ("fine_loc(rob1,room2_3)", "fine_in_hand(rob1,object2_1)", "fine_loc(object1_2,room1_4)")


def test_at_the_fine_resolution_rooms_show_their_cells() -> None:
    shown = scene_of(level(*IN_HAND))
    first, second = shown.places
    assert (first.name, first.cells) == ("room1", ("room1_1", "room1_2", "room1_3", "room1_4"))
    assert (first.things, first.robots, first.spots) == (("object1",), {}, {"object1": "room1_4"})
    assert (second.things, second.robots) == ((), {"rob1": ("object2",)})
    assert second.spots == {"rob1": "room2_3", "object2": "room2_3"}
    assert shown.rest == ()
    text = draw_text(shown)
    assert "object1 in room1_4" in text
    assert "[rob1] in room2_3 holds object2" in text


def test_the_picture_tells_cells_apart() -> None:
    elsewhere = [literal.replace("room1_4", "room1_2") for literal in IN_HAND]
    beside = (IN_HAND[0], "fine_loc(object2_1,room2_3)", IN_HAND[2])
    pictures = [picture(level(*literals)) for literals in (IN_HAND, elsewhere, beside)]
    assert len({image.tobytes() for image in pictures}) == 3
    assert len({image.shape for image in pictures}) == 1


def test_a_static_between_two_sorts_is_no_cell_of_the_other() -> None:
    owned = OFFICE.replace("next_to(room, room).", "next_to(room, room).  owner(object, robot).")
    world = world_of(parse_description(owned.replace("\nfacts", "\nfacts\n  owner(book1, rob1).")))
    core = Core(world, Rules(goal=()), ())
    core.reset(0, IN_KITCHEN)
    assert scene_of(core).places == scene_of(office()).places
