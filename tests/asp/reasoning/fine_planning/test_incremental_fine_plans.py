"""The fine planner in domains of all sorts, what it refuses, and what it keeps."""

import random
from functools import partial
from pathlib import Path

import pytest

from asp.language import Literal, analyse
from asp.reasoning.fine_planning import (
    FineStart,
    Horizons,
    IncrementalFinePlanner,
    NoPlan,
    fine_planner,
)
from asp.refinement import Refinement, load, load_refinement
from asp.translation import NotCompactError
from tests.asp.reasoning.fine_planning.fine_problems import drawn_goal, drawn_state, first_shortest
from tests.asp.refinement.levels import level
from tests.asp.refinement.locked import locked_texts
from tests.literals import parsed

HERE = Path(__file__).parents[2] / "refinement"
DOMAINS = {
    "tabletop": partial(load_refinement, str(HERE / "tabletop.fine")),
    "assistant": partial(load_refinement, str(HERE / "assistant.fine")),
    "locked": lambda: load(*locked_texts()),
    "L2": partial(level, "L2"),
}
LIMIT = 6


def _planner(refinement: Refinement, most: int = 32) -> IncrementalFinePlanner:
    return IncrementalFinePlanner(refinement.weak, refinement.weak_signature, most=most)


@pytest.mark.parametrize("name", DOMAINS)
def test_the_plan_is_the_first_shortest_that_a_search_finds(name: str) -> None:
    draw, planner = random.Random(21), _planner(DOMAINS[name]())
    for _ in range(30):
        start, goal = drawn_state(DOMAINS[name](), draw), drawn_goal(DOMAINS[name](), draw)
        found = planner.plan(start, goal, LIMIT)
        expected = first_shortest(DOMAINS[name](), start, goal, LIMIT)
        assert (None if isinstance(found, NoPlan) else found) == expected, (start, goal)


ROW = FineStart(
    frozenset(
        parsed(
            ["fine_loc(rob1,room1_1)", "fine_loc(object2_1,room2_1)", "fine_loc(object2_2,room2_1)"]
        )
    ),
    tuple(
        parsed(f"fine_loc({part},{cell})" for cell in ("room1_2", "room3_2"))
        for part in ("object1_1", "object1_2")
    ),
)


def _zoom(refinement: Refinement, *wholes: str) -> frozenset[str]:
    return frozenset(wholes).union(*(refinement.components[whole] for whole in wholes))


def test_of_places_where_a_thing_may_be_the_nearest_is_searched() -> None:
    plan = _planner(level("L2")).plan(ROW, parsed(["in_hand(rob1,object1)"]), LIMIT)
    assert plan == ("fine_move(rob1,room1_2)", "fine_pickup(rob1,object1_1)")


def test_a_goal_beyond_the_limit_is_told_from_one_out_of_reach() -> None:
    planner, goal = _planner(level("L2")), parsed(["loc(rob1,room3)"])
    assert planner.plan(ROW, goal, 3) is NoPlan.BEYOND_LIMIT
    # Without the room between there is no way.
    zoomed = _zoom(level("L2"), "rob1", "room1", "room3")
    assert planner.plan(ROW, goal, 3, zoomed) is NoPlan.OUT_OF_REACH


@pytest.mark.parametrize(
    "goal",
    [
        parsed(["in_hand(rob1,object1)", "in_hand(rob1,object2)"]),
        parsed(["loc(rob1,room1)", "loc(rob1,room3)"]),
        parsed(
            ["loc(object2,room2)", "-fine_loc(object2_1,room2_1)", "-fine_loc(object2_2,room2_2)"]
        ),
    ],
)
def test_what_no_state_satisfies_is_out_of_reach(goal: tuple[Literal, ...]) -> None:
    assert _planner(level("L2")).plan(ROW, goal, 10**6) is NoPlan.OUT_OF_REACH


def test_nothing_out_of_reach_is_reached_by_a_search_of_all_states() -> None:
    draw, planner, told = random.Random(5), _planner(level("L1")), 0
    for _ in range(150):
        start, goal = drawn_state(level("L1"), draw), drawn_goal(level("L1"), draw)
        if planner.plan(start, goal, 2) is NoPlan.OUT_OF_REACH:
            assert first_shortest(level("L1"), start, goal, 1_000) is None
            told += 1
    assert told


def test_what_is_nowhere_is_out_of_reach() -> None:
    nowhere = FineStart(ROW.true, ((),))
    planner = _planner(level("L2"))
    assert planner.plan(nowhere, parsed(["in_hand(rob1,object1)"]), LIMIT) is NoPlan.OUT_OF_REACH


def test_what_cannot_be_reached_without_its_place_is_out_of_reach() -> None:
    zoomed = _zoom(level("L2"), "rob1", "room1", "object2")
    planner = _planner(level("L2"))
    assert (
        planner.plan(ROW, parsed(["in_hand(rob1,object2)"]), LIMIT, zoomed) is NoPlan.OUT_OF_REACH
    )


def test_what_is_held_is_put_down_wherever_that_is() -> None:
    start = FineStart(frozenset(parsed(["fine_in_hand(rob1,object2_1)"])))
    planner, zoomed = _planner(level("L2")), _zoom(level("L2"), "rob1", "object2")
    plan = planner.plan(start, parsed(["-in_hand(rob1,object2)"]), LIMIT, zoomed)
    assert plan == ("fine_put_down(rob1,object2_1)",)


def test_a_goal_that_holds_needs_no_action() -> None:
    assert _planner(level("L2")).plan(ROW, parsed(["loc(rob1,room1)"]), LIMIT) == ()


def test_a_goal_about_what_is_zoomed_out_is_refused() -> None:
    zoomed = _zoom(level("L2"), "rob1", "room1")
    with pytest.raises(ValueError, match="room3"):
        _planner(level("L2")).plan(ROW, parsed(["loc(rob1,room3)"]), LIMIT, zoomed)


def test_candidates_are_values_of_what_always_has_one() -> None:
    odd = FineStart(
        ROW.true, (parsed(["fine_in_hand(rob1,object1_1)", "fine_in_hand(rob1,object1_2)"]),)
    )
    with pytest.raises(ValueError, match="always has one"):
        _planner(level("L2")).plan(odd, parsed(["in_hand(rob1,object1)"]), LIMIT)


def test_what_is_no_fluent_is_refused() -> None:
    odd = FineStart(ROW.true | {Literal.parse("fine_lok(rob1,room1_1)")})
    with pytest.raises(ValueError, match="no inertial fluent"):
        _planner(level("L2")).plan(odd, parsed(["loc(rob1,room2)"]), LIMIT)


def test_problems_that_differ_in_names_share_what_is_kept() -> None:
    planner = _planner(level("L2"))
    for one, other in (("room1", "room2"), ("room2", "room3")):
        start = FineStart(frozenset(parsed([f"fine_loc(rob1,{one}_1)"])))
        plan = planner.plan(
            start, parsed([f"loc(rob1,{other})"]), LIMIT, _zoom(level("L2"), "rob1", one, other)
        )
        assert plan == (f"fine_move(rob1,{one}_2)", f"fine_move(rob1,{other}_1)")
    assert planner.kept == 1


def test_no_more_is_kept_than_was_asked_for() -> None:
    planner = _planner(level("L2"), most=1)
    for _ in range(2):
        for room in ("room2", "room3"):
            assert planner.plan(ROW, parsed([f"loc(rob1,{room})"]), LIMIT)
            assert planner.kept == 1


def test_plans_are_the_same_where_little_is_kept() -> None:
    draw, planner = random.Random(3), _planner(level("L2"))
    forgetful = IncrementalFinePlanner(
        level("L2").weak, level("L2").weak_signature, horizons=Horizons(1)
    )
    for _ in range(20):
        start, goal = drawn_state(level("L2"), draw), drawn_goal(level("L2"), draw)
        assert forgetful.plan(start, goal, LIMIT) == planner.plan(start, goal, LIMIT)


LAMP = """
sorts
  lamp = {lamp1}.
fluents
  inertial lit(lamp).
  inertial dark(lamp).
actions
  agent light(lamp).
  agent quench(lamp).
laws
  light(L)  causes lit(L).
  quench(L) causes -lit(L).
  dark(L)  if -lit(L).
  -dark(L) if lit(L).
"""


def test_laws_about_what_is_false_are_translated_literally() -> None:
    source, signature = analyse(LAMP)
    with pytest.raises(NotCompactError, match="line 13"):
        IncrementalFinePlanner(source, signature)
    planner = fine_planner(source, signature)
    assert planner.plan(
        FineStart(frozenset(parsed(["lit(lamp1)"]))), parsed(["dark(lamp1)"]), LIMIT
    ) == ("quench(lamp1)",)
    assert (
        planner.plan(FineStart(frozenset(parsed(["dark(lamp1)"]))), parsed(["dark(lamp1)"]), LIMIT)
        == ()
    )


BROKEN = """
sorts
  lamp = {lamp1}.
fluents
  inertial lit(lamp).
  inertial broken(lamp).
actions
  agent light(lamp).
  agent mend(lamp).
laws
  light(L) causes lit(L).
  light(L) causes -lit(L) if broken(L).
  mend(L)  causes -broken(L).
"""


def test_no_plan_has_an_action_whose_effects_contradict_each_other() -> None:
    planner = IncrementalFinePlanner(*analyse(BROKEN))
    start = FineStart(frozenset(parsed(["broken(lamp1)"])))
    assert planner.plan(start, parsed(["lit(lamp1)"]), LIMIT) == ("mend(lamp1)", "light(lamp1)")
