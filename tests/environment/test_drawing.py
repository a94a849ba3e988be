"""The drawing of a scene for a page: whatever the domain, all of it is there and can be read."""

import re
from collections.abc import Iterable
from random import Random
from xml.etree import ElementTree

import pytest

from asp import load_description, parse_description
from asp.domains import LEVELS, level_text
from asp.language import Description, Literal, SourceError
from asp.refinement import load
from benchmarks.descriptions.drawing import random_description
from testbed.environment.rendering import Scene, Stage, draw_svg
from testbed.environment.rendering.scene import Place
from testbed.world import world_of
from tests.greenhouse import GREENHOUSE

SVG = "{http://www.w3.org/2000/svg}"
FARM = """
sorts
  tractor = {t7}.
  field   = {meadow, orchard, barnyard, paddock, heath}.
  crop    = {hay, wheat}.
statics
  lane(field, field).
fluents
  inertial parked(tractor, field).
  inertial lies(crop, field).
  inertial towed(tractor, crop).
  inertial fenced(field).
  inertial wet(crop).
actions
  agent drive(tractor, field).
laws
  drive(T, F) causes parked(T, F).
  -parked(T, F2) if parked(T, F1), F1 != F2.
facts
  lane(barnyard, meadow).  lane(barnyard, orchard).  lane(barnyard, paddock).
  lane(barnyard, heath).
sees
  T sees parked(T, F).
"""
SHELF = """
sorts
  hand  = {claw}.
  jar   = {salt, sage, thyme, mint}.
  under = jar + {plank}.
fluents
  inertial rests(jar, under).
  inertial chipped(jar).
  inertial dark.
actions
  agent shift(hand, jar, under).
laws
  shift(H, J, U) causes rests(J, U).
sees
  H sees rests(J, U) if hand(H).
"""
QUAY = """
sorts
  crane = {c1}.
  dock  = {north, south}.
  crate = {tea}.
statics
  beside(dock, dock).
fluents
  inertial stands(crane, dock).
  inertial stored(crate, dock).
actions
  agent roll(crane, dock).
laws
  roll(C, D) causes stands(C, D).
  -stands(C, D2) if stands(C, D1), D1 != D2.
  -stored(C, D2) if stored(C, D1), D1 != D2.
  beside(D1, D2) if beside(D2, D1).
facts
  beside(north, south).
initially
  stands(C, D) for some D.
  stored(C, D) for some D.
sees
  C sees stands(C, D).
"""
BERTHS = """
refines "quay.al".
magnify
  dock into berth.
components
  north = {north_a, north_b}.
  south = {south_a, south_b}.
counterparts
  beside. stands. stored. roll.
facts
  fine_beside(north_a, north_b).
  fine_beside(south_a, south_b).
  fine_beside(north_b, south_a).
tests
  C tests fine_stands(C, B).
  C tests fine_stored(T, B) if fine_stands(C, B).
"""


def drawn(text: str, true: str, marked: str = "") -> ElementTree.Element:
    return parsed(parse_description(text), true.split(), marked.split())


def parsed(
    description: Description, true: Iterable[str], marked: Iterable[str] = ()
) -> ElementTree.Element:
    scene = Stage(description).still(map(Literal.parse, true))
    return ElementTree.fromstring(draw_svg(scene, tuple(map(Literal.parse, marked))))


def texts(drawing: ElementTree.Element) -> list[str]:
    return ["".join(own.itertext()) for own in drawing.iter(f"{SVG}text")]


def label(drawing: ElementTree.Element) -> str:
    assert drawing.get("role") == "img"
    return drawing.get("aria-label", "")


def dashed(drawing: ElementTree.Element) -> int:
    return sum("stroke-dasharray" in own.attrib for own in drawing.iter())


def words(text: str) -> set[str]:
    return set(re.findall(r"\w+", text))


def test_places_show_who_and_what_is_in_them() -> None:
    drawing = drawn(FARM, "parked(t7,heath) towed(t7,hay) lies(hay,heath) lies(wheat,meadow)")
    shown = texts(drawing)
    for name in ("meadow", "orchard", "barnyard", "paddock", "heath", "t7", "hay", "wheat"):
        assert shown.count(name) >= 1
    said = {part.split(",")[0]: part for part in label(drawing).split(". ")}
    assert {"t7", "hay"} <= words(said["heath"])
    assert "wheat" in words(said["meadow"])
    assert words(said["orchard"]) & {"t7", "hay", "wheat"} == set()
    assert dashed(drawing) == 0


def test_what_else_is_said_of_a_thing_and_a_place_does_not_put_it_there() -> None:
    text = FARM.replace(
        "  inertial fenced", "  inertial ploughed(tractor, field).\n  inertial fenced"
    )
    drawing = drawn(text, "ploughed(t7,meadow) ploughed(t7,orchard) parked(t7,heath)")
    shown = texts(drawing)
    assert shown.count("t7") == 1
    assert {"ploughed meadow", "ploughed orchard"} <= set(shown)
    said = {part.split(",")[0]: part for part in label(drawing).split(". ")}
    assert "t7" in words(said["heath"])
    assert "t7" not in words(said["meadow"])


def test_each_way_between_places_is_a_door_of_the_drawing() -> None:
    """A centre with four neighbours cannot stand beside each of them in a row."""
    drawing = drawn(FARM, "parked(t7,heath)")
    for part in label(drawing).split(". "):
        place, _, rest = part.partition(":")[0].partition(", next to ")
        near = rest.split(", ")
        centre = place.startswith("barnyard")
        assert near == (["heath", "meadow", "orchard", "paddock"] if centre else ["barnyard"])
    openings = [p for p in drawing.iter(f"{SVG}path") if p.get("fill") == "var(--card)"]
    named = texts(drawing).count("barnyard") - 1
    assert len(openings) + named == 4  # a door on the spot, or the name of where it leads
    assert openings
    assert named


def test_marks_of_places_and_of_things_are_told() -> None:
    drawing = drawn(FARM, "fenced(orchard) wet(hay) lies(hay,orchard)")
    shown = texts(drawing)
    assert shown.count("fenced") == 1
    assert shown.count("not fenced") == 4
    assert "wet" in shown


@pytest.mark.parametrize(
    ("marked", "sign"),
    [
        ("-lies(hay,heath) lies(hay,meadow)", "≠"),
        ("towed(t7,hay)", "≠"),
        ("wet(hay)", "≠"),
        ("fenced(orchard)", "≠"),
        ("-parked(t7,heath) parked(t7,paddock)", "≠"),
        ("lies(wheat,meadow)", "?"),
    ],
)
def test_what_differs_has_a_dashed_outline_a_sign_and_a_word(marked: str, sign: str) -> None:
    true = "parked(t7,heath) lies(hay,heath)"
    drawing, plain = drawn(FARM, true, marked), drawn(FARM, true)
    assert (dashed(plain), dashed(drawing)) == (0, 1)
    assert texts(drawing).count(sign) == 1
    assert "differs" in label(drawing) or "not believed" in label(drawing)
    assert "differs" not in label(plain)


def test_without_places_what_stands_on_what_is_drawn_so() -> None:
    true = "rests(salt,plank) rests(sage,salt) rests(thyme,plank) chipped(sage) dark"
    drawing = drawn(SHELF, true, "-rests(sage,salt)")
    shown = texts(drawing)
    assert {"plank", "salt", "sage", "thyme", "chipped", "dark"} <= set(shown)
    assert dashed(drawing) == 1
    assert set(true.split()) - {"chipped(sage)"} <= set(
        re.findall(r"\w+\([^)]*\)|dark", label(drawing))
    )


def test_of_relations_that_say_as_much_the_first_one_declared_is_drawn() -> None:
    text = SHELF.replace("  inertial dark.", "  inertial beneath_all(jar, under).")
    true = "beneath_all(salt,plank) beneath_all(sage,plank) rests(salt,plank) rests(sage,plank)"
    for order in (true.split(), true.split()[::-1]):
        shown = texts(parsed(parse_description(text), order))
        assert any("rests(" in own for own in shown)
        assert "beneath_all plank" in shown


def test_what_stands_on_itself_in_the_end_is_a_list() -> None:
    drawing = drawn(SHELF, "rests(salt,sage) rests(sage,salt) rests(mint,mint)")
    assert {"rests(salt,sage)", "rests(sage,salt)", "rests(mint,mint)"} <= set(texts(drawing))


def test_towers_wider_than_the_drawing_are_a_list() -> None:
    jars = ", ".join(f"a_jar_with_a_long_name_{n}" for n in range(12))
    text = SHELF.replace("salt, sage, thyme, mint", jars)
    true = " ".join(f"rests({jar},plank)" for jar in jars.split(", "))
    assert set(true.split()) <= set(texts(drawn(text, true)))


def test_at_the_fine_resolution_cells_show_what_is_in_them() -> None:
    world = world_of(load(QUAY, "quay.al", BERTHS, "quay.fine"))
    true = world.true_atoms(world.state(["fine_stands(c1,north_b)", "fine_stored(tea,south_a)"]))
    drawing = parsed(world.description, true)
    assert {"north", "south", "c1", "tea", "a", "b"} == set(texts(drawing))
    assert "c1 in north_b" in label(drawing)
    assert "tea in south_a" in label(drawing)


@pytest.mark.parametrize("name", ["L1", "L3", "L6"])
def test_the_published_levels_are_drawn_with_all_that_is_in_them(name: str) -> None:
    size = LEVELS[name]
    coarse, fine = level_text(size.rooms, size.rows, size.columns, size.objects)
    world = world_of(load(coarse, "level.al", fine, "level.fine"))
    things = [f"object{n}" for n in range(1, sum(count for count, _ in size.objects) + 1)]
    spots = {thing: f"room{1 + n % size.rooms}_1" for n, thing in enumerate(things)}
    given = [f"fine_loc({thing}_1,{cell})" for thing, cell in spots.items()]
    drawing = parsed(
        world.description, world.true_atoms(world.state(["fine_loc(rob1,room1_2)", *given]))
    )
    said = label(drawing)
    for thing, cell in spots.items():
        assert f"{thing} in {cell}" in said
        assert thing in texts(drawing)
    assert {f"room{n}" for n in range(1, size.rooms + 1)} <= set(texts(drawing))


@pytest.mark.parametrize("text", [FARM, SHELF, GREENHOUSE])
def test_where_nothing_is_true_there_is_a_drawing_too(text: str) -> None:
    assert label(drawn(text, ""))


def test_equal_scenes_are_one_drawing() -> None:
    true = ["parked(t7,heath)", "lies(hay,heath)", "lies(wheat,heath)", "fenced(heath)"]
    stage = Stage(parse_description(FARM))
    one, other = (stage.still(map(Literal.parse, own)) for own in (true, true[::-1]))
    assert one == other
    assert draw_svg(one) == draw_svg(other)


def test_text_is_never_markup() -> None:
    bad = '<b a="1">&\'x'
    place = Place(bad, (bad,), {bad: (bad,)}, {bad: True}, frozenset({bad}))
    scene = Scene(0, (place,), (Literal(bad, (bad, bad)), Literal(bad)), "", "", "")
    drawing = ElementTree.fromstring(draw_svg(scene, [Literal(bad, ("elsewhere",))]))
    assert not list(drawing.iter(f"{SVG}b"))
    assert any(bad in own for own in texts(drawing))


def test_colours_are_those_of_the_page() -> None:
    text = draw_svg(Stage(load_description("office")).still([Literal.parse("loc(rob1,kitchen)")]))
    colours = re.findall(r'(?:fill|stroke)="([^"]*)"', text)
    assert colours
    assert all(own == "none" or own.startswith("var(--") for own in colours)


def test_a_name_that_is_too_long_is_told_in_its_title() -> None:
    name = "a_field_whose_name_is_longer_than_a_card_is_wide"
    drawing = drawn(FARM.replace("heath", name), f"parked(t7,{name})")
    titles = ["".join(own.itertext()) for own in drawing.iter(f"{SVG}title")]
    assert name in titles
    assert name in words(label(drawing))


@pytest.mark.parametrize("seed", range(60))
def test_whatever_is_described_is_drawn(seed: int) -> None:
    random = Random(seed)
    try:
        description = parse_description(random_description(random).text)
    except SourceError:
        return
    stage = Stage(description)
    fluents = description.fluents
    for _ in range(4):
        true = [fluent for fluent in fluents if random.random() < 0.4]
        sample = random.sample(fluents, len(fluents) // 3)
        marked = [f.complement if f in true else f for f in sample]
        scene = stage.still(true)
        drawing = ElementTree.fromstring(draw_svg(scene, marked))
        said = words(label(drawing)) | words(" ".join(texts(drawing)))
        assert {constant for fluent in true for constant in fluent.arguments} <= said
        assert {place.name for place in scene.places} <= said
        assert bool(dashed(drawing)) is bool(marked)
