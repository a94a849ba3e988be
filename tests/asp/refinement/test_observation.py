"""What a robot knows by testing, and what each family of generated axioms contributes."""

from collections.abc import Callable
from functools import cache, partial

import pytest

from asp import parse_description
from asp.domains import LevelSize, level_text
from asp.refinement import load
from asp.translation import translate
from testbed.world import world_of
from tests.asp.reasoning.diagrams import after
from tests.asp.refinement.levels import of_size
from tests.asp.refinement.locked import locked_texts

SMALL = partial(of_size, LevelSize(2, 1, 2, ((1, 2),)))
AT_HOME = (
    *("fine_loc(rob1,room1_1)", "fine_loc(object1_1,room1_1)", "fine_loc(object1_2,room1_1)"),
)
AWAY = (*("fine_loc(rob1,room1_1)", "fine_loc(object1_1,room2_2)", "fine_loc(object1_2,room2_2)"),)
HERE, THERE = "test_fine_loc(rob1,object1_1,room1_1)", "test_fine_loc(rob1,object1_1,room1_2)"


@cache
def program(text: str) -> str:
    return translate(text)


def outcome(text: str, state: tuple[str, ...], *actions: str) -> frozenset[str] | None:
    """What is true after the actions, one a step; None: they cannot be done."""
    found = after(program(text), state, *([action] for action in actions))
    assert len(found) <= 1
    return next(iter(found), None)


def knows(text: str, state: tuple[str, ...], *actions: str) -> frozenset[str]:
    true = outcome(text, state, *actions) or frozenset()
    return frozenset(atom for atom in true if atom.startswith("observed_"))


def a_test_tells_that_it_is_so(text: str) -> bool:
    return "observed_fine_loc(rob1,object1_1,room1_1,true)" in knows(text, AT_HOME, HERE)


def a_test_tells_that_it_is_not_so(text: str) -> bool:
    return "observed_fine_loc(rob1,object1_1,room1_1,false)" in knows(text, AWAY, HERE)


def a_hand_is_felt(text: str) -> bool:
    return {
        "observed_fine_in_hand(rob1,object1_1,true)",
        "observed_fine_in_hand(rob1,object1_2,false)",
    } <= knows(
        text,
        (*AT_HOME, "fine_in_hand(rob1,object1_1)"),
        *("test_fine_in_hand(rob1,object1_1)", "test_fine_in_hand(rob1,object1_2)"),
    )


def another_cell_cannot_be_tested(text: str) -> bool:
    return outcome(text, AT_HOME, THERE) is None


def ones_own_cell_can_be_tested(text: str) -> bool:
    return outcome(text, AT_HOME, HERE) is not None


def a_hand_can_be_tested(text: str) -> bool:
    return outcome(text, AWAY, "test_fine_in_hand(rob1,object1_2)") is not None


def a_later_test_replaces_an_earlier_one(text: str) -> bool:
    known = knows(text, AT_HOME, HERE, "fine_exo_move(object1_1,room2_1)", HERE)
    return (
        "observed_fine_loc(rob1,object1_1,room1_1,false)" in known
        and "observed_fine_loc(rob1,object1_1,room1_1,true)" not in known
    )


def a_later_feeling_replaces_an_earlier_one(text: str) -> bool:
    feel = "test_fine_in_hand(rob1,object1_1)"
    known = knows(text, AT_HOME, feel, "fine_pickup(rob1,object1_1)", feel)
    return (
        "observed_fine_in_hand(rob1,object1_1,true)" in known
        and "observed_fine_in_hand(rob1,object1_1,false)" not in known
    )


def parts_are_seen_together(text: str) -> bool:
    return "observed_fine_loc(rob1,object1_2,room1_1,true)" in knows(text, AT_HOME, HERE)


def one_cell_tells_of_the_room(text: str) -> bool:
    return "observed_loc(rob1,object1,room1,true)" in knows(text, AT_HOME, HERE)


def one_part_tells_of_the_object(text: str) -> bool:
    return "observed_in_hand(rob1,object1,true)" in knows(
        text, (*AT_HOME, "fine_in_hand(rob1,object1_1)"), "test_fine_in_hand(rob1,object1_1)"
    )


def all_cells_tell_that_it_is_not_in_the_room(text: str) -> bool:
    known = knows(text, AWAY, HERE, "fine_move(rob1,room1_2)", THERE)
    return "observed_loc(rob1,object1,room1,false)" in known


def one_cell_does_not(text: str) -> bool:
    return "observed_loc(rob1,object1,room1,false)" not in knows(text, AWAY, HERE)


def all_parts_tell_that_it_is_not_held(text: str) -> bool:
    both = ("test_fine_in_hand(rob1,object1_1)", "test_fine_in_hand(rob1,object1_2)")
    return "observed_in_hand(rob1,object1,false)" in knows(text, AT_HOME, *both)


def one_part_does_not(text: str) -> bool:
    known = knows(text, AT_HOME, "test_fine_in_hand(rob1,object1_1)")
    return "observed_in_hand(rob1,object1,false)" not in known


def what_is_tested_stays_as_it_is(text: str) -> bool:
    for state in (AT_HOME, AWAY):
        before, now = (
            {a for a in found or () if not a.startswith(("observed_", "possible_"))}
            for found in (outcome(text, state), outcome(text, state, HERE))
        )
        if not now or before != now:
            return False
    return True


CLAIMS: list[Callable[[str], bool]] = [
    a_test_tells_that_it_is_so,
    a_test_tells_that_it_is_not_so,
    a_hand_is_felt,
    another_cell_cannot_be_tested,
    ones_own_cell_can_be_tested,
    a_hand_can_be_tested,
    a_later_test_replaces_an_earlier_one,
    a_later_feeling_replaces_an_earlier_one,
    parts_are_seen_together,
    one_cell_tells_of_the_room,
    one_part_tells_of_the_object,
    all_cells_tell_that_it_is_not_in_the_room,
    one_cell_does_not,
    all_parts_tell_that_it_is_not_held,
    one_part_does_not,
    what_is_tested_stays_as_it_is,
]


@pytest.mark.parametrize("claim", CLAIMS)
def test_it_holds(claim: Callable[[str], bool]) -> None:
    assert claim(SMALL().strong.text)


@pytest.mark.parametrize(
    ("head", "broken"),
    [
        ("test_fine_loc(R, Y1, Y2) causes observed_fine_loc(R, Y1, Y2, true)", 0),
        ("test_fine_loc(R, Y1, Y2) causes observed_fine_loc(R, Y1, Y2, false)", 1),
        ("-observed_fine_loc(R, Y1, Y2, V1) if", 6),
        ("test_fine_in_hand(R, Y2) causes observed_fine_in_hand(R, Y2, true)", 2),
        ("test_fine_in_hand(R, Y2) causes observed_fine_in_hand(R, Y2, false)", 2),
        ("-observed_fine_in_hand(R, Y2, V1) if", 7),
        ("impossible test_fine_loc(R, Y1, Y2) if", 3),
        ("can_test_fine_loc(R, T, C) if", 4),
        ("can_test_fine_in_hand(R, P)", 5),
        ("observed_fine_loc(R, Y_1, Y2, V) if", 8),
        ("observed_loc(R, X1, X2, true) if", 9),
        ("possible_loc(R, X1, X2) if", 12),
        ("observed_loc(R, X1, X2, false) if", 11),
        ("observed_in_hand(R, X2, true) if", 10),
        ("possible_in_hand(R, X2) if", 14),
        ("observed_in_hand(R, X2, false) if", 13),
    ],
)
def test_without_one_of_the_axioms_a_claim_fails(head: str, broken: int) -> None:
    lines = SMALL().strong.text.split("\n")
    (removed,) = [line for line in lines if line.strip().startswith(head)]
    assert not CLAIMS[broken]("\n".join(line for line in lines if line != removed))


def test_one_fluent_may_be_testable_for_several_reasons() -> None:
    """Here a robot can also test where it is itself, in whatever cell it is."""
    coarse, fine = level_text(2, 1, 2, ((1, 2),))
    text = load(
        coarse, "c.al", f"{fine}  R tests fine_loc(R, C) if robot(R).\n", "x.fine"
    ).strong.text
    own = "test_fine_loc(rob1,rob1,room2_1)"
    assert outcome(SMALL().strong.text, AT_HOME, own) is None
    assert "observed_fine_loc(rob1,rob1,room2_1,false)" in knows(text, AT_HOME, own)
    assert all(claim(text) for claim in CLAIMS)


class TestConditionsOnCoarseAttributes:
    """Each of the conditions that were lifted keeps something from happening in a locked room."""

    @pytest.mark.parametrize(
        ("head", "atoms", "action"),
        [
            (
                "impossible fine_move(R, C2) if component(C2, L2)",
                ("fine_loc(rob1,l1)", "fine_loc(cover,l1)"),
                "fine_move(rob1,k2)",
            ),
            (
                "impossible fine_move(R, C) if component(C, L)",
                ("fine_loc(rob1,k2)", "fine_loc(cover,l1)"),
                "fine_move(rob1,l1)",
            ),
            (
                "impossible fine_exo_move(P, C) if component(P, O), component(C, L)",
                ("fine_loc(rob1,k2)", "fine_loc(cover,k1)"),
                "fine_exo_move(cover,l1)",
            ),
            (
                "impossible fine_exo_move(P, C2) if component(P, O), component(C2, L2)",
                ("fine_loc(rob1,k2)", "fine_loc(cover,l1)"),
                "fine_exo_move(cover,k1)",
            ),
        ],
    )
    def test_without_it_that_happens(self, head: str, atoms: tuple[str, ...], action: str) -> None:
        text = load(*locked_texts()).weak.text
        lines = text.split("\n")
        (removed,) = [line for line in lines if line.strip().startswith(head)]
        less = "\n".join(line for line in lines if line != removed)
        for told, possible in ((text, False), (less, True)):
            world = world_of(parse_description(told))
            state = world.state([*atoms, "locked(library)"])
            assert world.executable(state, [action]) == possible
