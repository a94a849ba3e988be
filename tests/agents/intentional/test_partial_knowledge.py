"""Robots that start knowing only what they see: both ways of reasoning, and what comes of it."""

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from agents.intentional import IntentionalRobot
from agents.intentional.checking import CheckingRobot
from agents.intentional.reasoners import ReferenceReasoner
from asp.language import parse_description
from testbed.protocol import Decision
from testbed.world import world_of
from tests.agents.intentional.lives import Place, Wish, live, place
from tests.agents.intentional.test_incremental import BOTH
from tests.literals import parsed

LIBRARY = place("library", dark=True)
OFFICE = place("office", dark=True)
BRIGHT = place("library")
LIBRARY_STATES = list(LIBRARY.world.initial_states())
OFFICE_STATES = list(OFFICE.world.initial_states())
LITERALS = [literal for fluent in LIBRARY.world.fluents for literal in (fluent, f"-{fluent}")]
DELIVERED = parsed(["loc(book1,office2)", "loc(cookbook1,office2)", "-in_hand(rob1,cookbook1)"])

wishes = st.dictionaries(
    st.integers(1, 15),
    st.builds(Wish, st.integers(0, 12), st.booleans(), st.booleans(), st.integers(0, 3)),
    max_size=2,
)
slow = settings(max_examples=8)


@slow
@given(initial=st.sampled_from(LIBRARY_STATES), wishes=wishes)
def test_both_ways_agree_where_defaults_say_where_things_are(
    initial: int, wishes: dict[int, Wish]
) -> None:
    live(IntentionalRobot(BOTH), initial, DELIVERED, wishes, steps=18, where=LIBRARY)


@slow
@given(initial=st.sampled_from(OFFICE_STATES), wishes=wishes)
def test_both_ways_agree_where_nothing_does(initial: int, wishes: dict[int, Wish]) -> None:
    goal = parsed(["loc(book1,office2)", "loc(book2,office1)"])
    live(IntentionalRobot(BOTH), initial, goal, wishes, steps=18, where=OFFICE)


@slow
@given(
    initial=st.sampled_from(LIBRARY_STATES),
    goal=st.lists(st.sampled_from(LITERALS), min_size=1, max_size=2),
    wishes=wishes,
    where=st.sampled_from([LIBRARY, BRIGHT]),
)
def test_both_ways_agree_whatever_the_goal(
    initial: int, goal: list[str], wishes: dict[int, Wish], where: Place
) -> None:
    live(IntentionalRobot(BOTH), initial, goal, wishes, steps=12, where=where)


def _initial(*true: str) -> int:
    return LIBRARY.world.state(true)


def _actions(decisions: list[Decision]) -> list[str]:
    return [d.action for d in decisions if d.action not in ("wait", "finish")]


def test_a_robot_goes_where_defaults_say_and_finds_what_it_wants() -> None:
    start = _initial(
        "loc(rob1,office2)", "loc(book1,library)", "loc(book2,library)", "loc(cookbook1,kitchen)"
    )
    life = live(IntentionalRobot(), start, parsed(["in_hand(rob1,book1)"]), where=LIBRARY)
    assert _actions(list(life.decisions)) == [
        "move(rob1,kitchen)",
        "move(rob1,library)",
        "pickup(rob1,book1)",
    ]
    assert life.achieved
    assert [d.trace.explanation.exceptions for d in life.decisions if d.trace.explanation] == [[]]


def test_a_robot_that_sees_otherwise_goes_where_the_next_default_says() -> None:
    start = _initial(
        "loc(rob1,kitchen)", "loc(book1,office1)", "loc(book2,library)", "loc(cookbook1,kitchen)"
    )
    life = live(IntentionalRobot(), start, parsed(["loc(book1,kitchen)"]), where=LIBRARY)
    assert _actions(list(life.decisions)) == [
        "move(rob1,library)",
        "move(rob1,kitchen)",
        "move(rob1,office2)",
        "move(rob1,office1)",
        "pickup(rob1,book1)",
        "move(rob1,office2)",
        "move(rob1,kitchen)",
    ]
    assert life.achieved
    told = [d.trace.explanation.exceptions for d in life.decisions if d.trace.explanation]
    assert told == [[], ["-loc(book1,library)"]]


def test_a_cookbook_is_looked_for_in_the_kitchen() -> None:
    start = _initial(
        "loc(rob1,office2)", "loc(book1,library)", "loc(book2,library)", "loc(cookbook1,kitchen)"
    )
    life = live(IntentionalRobot(), start, parsed(["in_hand(rob1,cookbook1)"]), where=LIBRARY)
    assert _actions(list(life.decisions)) == ["move(rob1,kitchen)", "pickup(rob1,cookbook1)"]


@pytest.mark.parametrize("reasoner", [None, ReferenceReasoner], ids=["kept", "plain"])
def test_without_defaults_what_must_be_somewhere_is_where_comes_first(
    reasoner: type[ReferenceReasoner] | None,
) -> None:
    """From office2 the robot sees neither book, and assumes the first room of all."""
    start = OFFICE.world.state(
        parsed(["loc(rob1,office2)", "loc(book1,library)", "loc(book2,library)"])
    )
    robot = IntentionalRobot() if reasoner is None else IntentionalRobot(reasoner)
    life = live(robot, start, parsed(["loc(book1,office2)"]), where=OFFICE, steps=2)
    assert {"loc(book1,kitchen)", "loc(book2,kitchen)"} <= set(life.decisions[0].trace.belief)
    assert "locked(library)" not in life.decisions[0].trace.belief


SIGNAL = OFFICE.source.replace(
    "inertial locked(secure_room).", "inertial locked(secure_room).\n  defined signal."
).replace("  % State constraints.", "  signal if locked(library).\n")


@pytest.mark.parametrize("locked", [True, False])
def test_a_defined_fluent_that_is_seen_at_the_start_needs_its_reason(locked: bool) -> None:
    """From office1 the lock itself is out of sight."""
    source = SIGNAL + "sees\n  R sees signal if robot(R).\n"
    world = world_of(parse_description(source, "office.al"))
    where = Place("office", world, source, dark=True)
    true = parsed(["loc(rob1,office1)", "loc(book1,office1)", "loc(book2,office1)"])
    start = world.state(parsed([*true, *["locked(library)"] * locked]))
    life = live(IntentionalRobot(BOTH), start, parsed(["loc(book1,office2)"]), steps=3, where=where)
    assert ("locked(library)" in life.decisions[0].trace.belief) is locked


def test_an_exception_is_assumed_rather_than_an_event_that_would_do() -> None:
    """That book2 is in the kitchen takes two exceptions, or one event; and nobody says which."""
    start = _initial(
        "loc(rob1,office1)", "loc(book1,library)", "loc(book2,kitchen)", "loc(cookbook1,kitchen)"
    )
    goal = parsed(["loc(book2,office1)"])
    life = live(IntentionalRobot(), start, goal, where=LIBRARY)
    explanations = [d.trace.explanation for d in life.decisions if d.trace.explanation]
    assert explanations[-1].exceptions == ["-loc(book2,library)", "-loc(book2,office1)"]
    assert explanations[-1].unobserved == []


@pytest.mark.parametrize("room", ["library", "office1"])
def test_a_robot_that_checks_does_not_finish_on_a_default(room: str) -> None:
    start = _initial(
        "loc(rob1,office2)", f"loc(book1,{room})", "loc(book2,library)", "loc(cookbook1,kitchen)"
    )
    goal = parsed(["loc(book1,library)"])
    trusting = live(IntentionalRobot(), start, goal, where=LIBRARY, feedback=False)
    assert [d.action for d in trusting.decisions] == ["finish"]
    checking = live(CheckingRobot(), start, goal, where=LIBRARY, feedback=False)
    assert checking.finished
    assert checking.achieved
    assert "move(rob1,library)" in _actions(list(checking.decisions))
