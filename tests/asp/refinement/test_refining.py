"""The refined description says what one written by hand says, law by law and of other domains."""

import re
from functools import cache
from itertools import combinations
from pathlib import Path

import pytest

from asp import parse_description
from asp.domains import LevelSize, level_text
from asp.language import analyse
from asp.refinement import Refinement, load, load_refinement, parse_fine, shared_places
from asp.translation import translate_source
from testbed.world import World, world_of
from tests.asp.reasoning.diagrams import warnings_of
from tests.asp.refinement.levels import level, of_size
from tests.asp.refinement.locked import locked_texts

HERE = Path(__file__).parent
TWO_ROOMS = LevelSize(2, 1, 2, ((1, 2),))

State = frozenset[str]
Diagram = dict[tuple[State, tuple[str, ...]], frozenset[State]]


def diagram(text: str) -> Diagram:
    """The successors of every state under every compound action of up to two actions."""
    world = world_of(parse_description(text))
    actions = sorted(world.agent_actions + world.exogenous_actions)
    compounds = [c for size in range(3) for c in combinations(actions, size)]

    def atoms(state: int) -> State:
        return frozenset(world.true_atoms(state))

    return {
        (atoms(state), compound): frozenset(map(atoms, world.successors(state, compound)))
        for state in world.states()
        for compound in compounds
    }


@cache
def by_hand() -> Diagram:
    return diagram((HERE / "by_hand.al").read_text(encoding="utf-8"))


class TestWeak:
    def test_it_is_the_description_written_by_hand(self) -> None:
        found = diagram(of_size(TWO_ROOMS).weak.text)
        assert len(found) > 5000
        assert found == by_hand()

    def test_initial_states_are_those_of_the_description_written_by_hand(self) -> None:
        texts = (of_size(TWO_ROOMS).weak.text, (HERE / "by_hand.al").read_text(encoding="utf-8"))
        found, expected = (
            {
                frozenset(w.true_atoms(s))
                for w in [world_of(parse_description(t))]
                for s in w.initial_states()
            }
            for t in texts
        )
        assert found == expected

    @pytest.mark.parametrize(
        "head",
        [
            "fine_move(R, C) causes",
            "fine_pickup(R, P) causes",
            "fine_put_down(R, P) causes",
            "fine_exo_move(P, C) causes",
            "fine_next_to(C1, C2) if",
            "-fine_loc(T1, C2) if",
            "fine_loc(P, C) if",
            "-fine_in_hand(R, P1) if",
            "impossible fine_move(R, C2) if",
            "impossible fine_put_down(R, P) if",
            "impossible fine_pickup(R, P1) if",
            "impossible fine_pickup(R, P) if",
            "impossible fine_exo_move(P, C) if fine_loc",
            "impossible fine_exo_move(P, C) if fine_in_hand",
            "loc(X1, X2) if",
            "in_hand(X1, X2) if",
            "fine_loc(P1, C) if",
            "component(object1_1,",
            "fine_next_to(room1_2, room2_1)",
        ],
    )
    def test_without_one_of_its_laws_it_is_another(self, head: str) -> None:
        assert diagram(without(of_size(TWO_ROOMS).weak.text, head)) != by_hand()

    def test_that_none_moves_where_it_is_follows_from_the_map(self) -> None:
        """No cell is next to itself; the law gives the reason."""
        text = without(of_size(TWO_ROOMS).weak.text, "impossible fine_move(R, C) if")
        assert diagram(text) == by_hand()

    def test_every_generated_law_says_which_coarse_law_it_came_from(self) -> None:
        refinement = load_refinement("office.fine")
        coarse = refinement.coarse.text.split("\n")
        laws = refinement.weak.text.partition("\nlaws\n")[2].partition("% Bridge")[0].split("\n")
        named = [
            re.fullmatch(r"  \S.*\.  % line (\d+): (.*)", line) for line in laws if "% line" in line
        ]
        assert len({found[1] for found in named if found}) == 24, "every law of the office"
        for found in named:
            assert found is not None
            stated = re.sub(r"\s*(%.*)?$", "", coarse[int(found[1]) - 1]).strip()
            assert re.sub(r"\s+", " ", stated) == found[2]


def without(text: str, head: str) -> str:
    """The text without the one law or fact that begins so."""
    lines = text.split("\n")
    found = [line for line in lines if line.strip().startswith(head)]
    assert len(found) == 1, found
    return "\n".join(line for line in lines if line != found[0])


@cache
def locked_room() -> World:
    return world_of(parse_description(load(*locked_texts()).weak.text))


def after(*atoms: str, does: str) -> set[str] | None:
    """What is true where an action is done in the one state with these atoms; None: it cannot."""
    world = locked_room()
    state = world.state(atoms)
    if not world.executable(state, [does]):
        return None
    return set(world.true_atoms(world.successor(state, [does])))


KITCHEN = ("fine_loc(rob1,k2)", "fine_loc(cover,k1)")
LIBRARY = ("fine_loc(rob1,l1)", "fine_loc(cover,l1)", "locked(library)")


class TestLocks:
    def test_a_locked_room_cannot_be_entered(self) -> None:
        assert after(*KITCHEN, does="fine_move(rob1,l1)") is not None
        assert after(*KITCHEN, "locked(library)", does="fine_move(rob1,l1)") is None

    def test_a_locked_room_cannot_be_left_and_one_can_move_in_it(self) -> None:
        assert after(*LIBRARY, does="fine_move(rob1,k2)") is None
        moved = after(*LIBRARY, does="fine_move(rob1,l2)")
        assert moved is not None
        assert {"fine_loc(rob1,l2)", "loc(rob1,library)"} <= moved

    def test_nothing_is_moved_into_or_out_of_a_locked_room_but_inside_it(self) -> None:
        assert after(*LIBRARY, does="fine_exo_move(spine,k1)") is None
        assert after(*LIBRARY, does="fine_exo_move(spine,l2)") is not None
        assert after(*KITCHEN, "locked(library)", does="fine_exo_move(cover,l1)") is None
        assert after(*KITCHEN, "locked(library)", does="fine_exo_move(cover,k2)") is not None

    @pytest.mark.parametrize("cell", ["k1", "k2"])
    def test_a_room_is_unlocked_from_any_cell_of_its_neighbour(self, cell: str) -> None:
        atoms = (f"fine_loc(rob1,{cell})", "fine_loc(cover,k1)", "locked(library)")
        unlocked = after(*atoms, does="unlock(rob1,library)")
        assert unlocked is not None
        assert "locked(library)" not in unlocked

    def test_what_is_seen_and_shown_of_locks_carries_over(self) -> None:
        world = locked_room()
        seen = world.visible(world.state([*KITCHEN, "locked(library)"]), "rob1")
        assert seen == ("locked(library)",)
        shows = {(s.action, s.fluent) for s in world.description.shows}
        assert ("fine_move(rob1,l2)", "locked(library)") in shows
        assert ("unlock(rob1,library)", "locked(library)") in shows
        assert not any(fluent.startswith(("loc(", "in_hand(", "fine")) for _, fluent in shows)


@pytest.mark.parametrize(
    "condition",
    [
        "impossible move(R, L) if secure_room(L)",
        "impossible move(R, L) if L = library",
        "impossible move(R, library)",
        "impossible move(R, L) if L != kitchen",
        "impossible move(R, library) if loc(R, kitchen)",
    ],
)
def test_a_condition_on_some_rooms_only_does_not_bind_inside_them(condition: str) -> None:
    """The library cannot be entered; who is in it can go about in it, and leave it."""
    text, *others = locked_texts()
    coarse = text.replace("\nlaws\n", f"\nlaws\n  {condition}.\n")
    world = world_of(parse_description(load(coarse, *others).weak.text))
    inside, outside = (
        world.state([f"fine_loc(rob1,{cell})", "fine_loc(cover,k1)"]) for cell in ("l1", "k2")
    )
    assert not world.executable(outside, ["fine_move(rob1,l1)"])
    assert world.executable(inside, ["fine_move(rob1,l2)"])
    assert world.executable(inside, ["fine_move(rob1,k2)"])


def test_an_effect_that_depends_on_the_room_depends_on_the_cell_s_room() -> None:
    text, *others = locked_texts()
    laws = "move(R, L) causes locked(L) if L = library, loc(R, kitchen)."
    coarse = text.replace("\nlaws\n", f"\nlaws\n  {laws}\n")
    world = world_of(parse_description(load(coarse, *others).weak.text))
    outside = world.state(["fine_loc(rob1,k2)", "fine_loc(cover,k1)"])
    assert world.holds(world.successor(outside, ["fine_move(rob1,l1)"]), "locked(library)")
    assert not world.holds(world.successor(outside, ["fine_move(rob1,k1)"]), "locked(library)")


class TestEveryRefinement:
    @pytest.mark.parametrize("name", ["L1", "L2", "office", "tabletop"])
    @pytest.mark.parametrize("n", [0, 1, 2])
    def test_clingo_accepts_its_program_without_a_warning(self, name: str, n: int) -> None:
        refinement = of(name)
        for source, signature in (
            (refinement.weak, refinement.weak_signature),
            (refinement.strong, refinement.strong_signature),
        ):
            program = translate_source(source, signature).replace("#const n = 1.", "")
            assert warnings_of(f"#const n = {n}.\n" + program) == []

    @pytest.mark.parametrize("name", ["L1", "L2", "office", "tabletop"])
    def test_its_text_is_a_description_like_any_other(self, name: str) -> None:
        refinement = of(name)
        for source, signature in (
            (refinement.weak, refinement.weak_signature),
            (refinement.strong, refinement.strong_signature),
        ):
            assert analyse(source.text, source.file) == (source, signature)

    @pytest.mark.parametrize("name", ["L1", "L2", "office", "tabletop"])
    def test_constants_and_components_are_each_other_s(self, name: str) -> None:
        refinement = of(name)
        for whole, parts in refinement.components.items():
            assert all(refinement.wholes[part] == whole for part in parts)
        assert set(refinement.wholes) == {p for ps in refinement.components.values() for p in ps}


def of(name: str) -> Refinement:
    if name.startswith("L"):
        return level(name)
    return load_refinement("office.fine" if name == "office" else str(HERE / f"{name}.fine"))


@pytest.mark.parametrize(
    ("law", "shared"),
    [
        ("fine_loc(P1, C) if fine_loc(P2, C), component(P1, O), component(P2, O)", True),
        ("fine_loc(P1, C) if component(P2, O), P1 != P2, component(P1, O), fine_loc(P2, C)", True),
        (
            "fine_loc(P1, C) if fine_loc(P2, C), component(P1, O), component(P2, O), room(room1)",
            False,
        ),
        (
            "fine_loc(P1, C1) if fine_loc(P2, C2), component(P1, O), component(P2, O), C1 = C2",
            False,
        ),
        ("fine_loc(P1, C) if fine_loc(P2, C), component(P1, O1), component(P2, O2)", False),
        (
            "-fine_loc(P1, C) if fine_loc(P2, C), component(P1, O), component(P2, O), P1 != P2",
            False,
        ),
        ("fine_loc(P1, C) if -fine_loc(P2, C), component(P1, O), component(P2, O)", False),
        (
            "fine_loc(P1, C) if fine_loc(P2, C), component(P1, O), component(P2, O), C = room1_1",
            False,
        ),
    ],
)
def test_which_laws_say_that_components_share_a_fluent(law: str, shared: bool) -> None:
    found = shared_places(parse_fine(f"laws\n  {law}.\n"))
    assert found == (frozenset({("fine_loc", 0)}) if shared else frozenset())


def test_where_parts_need_not_stay_together_any_of_them_counts() -> None:
    text = level_text(2, 1, 2, ((1, 2),))
    kept = "fine_loc(P1, C) if fine_loc(P2, C), C != room1_1"
    fine, number = re.subn(r"^  fine_loc\(P1, C\) if fine_loc\(P2, C\)", kept, text[1], flags=re.M)
    assert number == 1
    refined = load(text[0], "c.al", fine, "x.fine")
    law = (
        "impossible fine_pickup(R, P) if fine_loc(R, C1), fine_loc(P1, C2), C1 != C2, "
        "component(P, O), component(P1, O)."
    )
    assert law in refined.weak.text
    assert "Y_1" not in refined.strong.text


def test_a_fine_literal_says_what_follows_at_the_coarse_resolution() -> None:
    refinement = level("L2")
    assert refinement.coarse_of("fine_loc(object1_2,room3_1)") == ("loc(object1,room3)",)
    assert refinement.coarse_of("fine_loc(rob1,room3_1)") == ("loc(rob1,room3)",)
    assert refinement.coarse_of("-fine_loc(rob1,room3_1)") == ()
    assert refinement.coarse_of("fine_move(rob1,room3_1)") == ("move(rob1,room3)",)
    assert refinement.coarse_of("-fine_in_hand(rob1,object1_1)") == ()
    assert level("L1").coarse_of("-fine_in_hand(rob1,object1_1)") == ("-in_hand(rob1,object1)",)


def test_a_coarse_literal_holds_by_some_components_and_fails_by_all() -> None:
    refinement = level("L2")
    assert refinement.counterpart("in_hand(rob1,object1)") == (
        ("fine_in_hand(rob1,object1_1)",),
        ("fine_in_hand(rob1,object1_2)",),
    )
    assert refinement.counterpart("-loc(rob1,room2)") == (
        ("-fine_loc(rob1,room2_1)", "-fine_loc(rob1,room2_2)"),
    )
    office = load_refinement("office.fine")
    assert office.counterpart("-locked(library)") == (("-locked(library)",),)
    assert office.coarse_of("exo_lock(library)") == ("exo_lock(library)",)
