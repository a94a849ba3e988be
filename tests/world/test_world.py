"""The compiled world of the office against hand-made facts about it (D 1.1)."""

import pytest

from asp import load_description, parse_description
from testbed.world import (
    NotExecutableError,
    StateError,
    UnknownActionError,
    UnknownFluentError,
    World,
    world_of,
)

SCENARIO_1 = ("loc(rob1,kitchen)", "in_hand(rob1,book1)", "loc(book2,kitchen)")
PLAN = (
    "move(rob1,library)",
    "put_down(rob1,book1)",
    "move(rob1,kitchen)",
    "pickup(rob1,book2)",
    "move(rob1,library)",
    "put_down(rob1,book2)",
)
GOAL = ("loc(book1,library)", "loc(book2,library)", "-in_hand(rob1,book1)", "-in_hand(rob1,book2)")

# Once h holds, f and g exclude each other, and nothing says which of them goes.
UNDETERMINED = """
sorts
  thing = {it}.
fluents
  inertial f.  inertial g.  inertial h.  defined p.
actions
  agent a.
laws
  a causes h.
  -f if g, h.
  -g if f, h.
  p if f.
"""


@pytest.fixture(scope="module")
def world() -> World:
    return world_of(load_description("office"))


def test_the_office_has_430_states_and_192_initial_ones(world: World) -> None:
    # Each of rob1, book1 and book2 is in one of four rooms or nowhere. A held book is where the
    # robot is, if the robot is anywhere.
    nothing_held = 5 * 5 * 5
    held_in_a_room = 2 * 4 * 5
    held_by_a_robot_nowhere = 2 * 5 * 5
    states = list(world.states())
    assert len(states) == len(set(states)) == 430
    assert 2 * (nothing_held + held_in_a_room + held_by_a_robot_nowhere) == 430
    # P 4: the library locked or not, book1 held, book2 held, or nothing held.
    initial = world.initial_states()
    assert len(set(initial)) == 2 * (4 * 4 + 4 * 4 + 4 * 4 * 4) == 192
    assert set(initial) <= set(states)


def test_states_are_exactly_the_closed_sets_of_fluents(world: World) -> None:
    closed = [s for s in range(1 << len(world.fluents)) if world.is_state(s)]
    assert closed == sorted(world.states())


def test_the_published_plan_achieves_the_goal_and_no_shorter_part_does(world: World) -> None:
    state = world.state(SCENARIO_1)
    for action in PLAN:
        assert not world.satisfies(state, GOAL)
        state = world.successor(state, [action])
    assert world.satisfies(state, GOAL)


def test_what_is_held_goes_along(world: World) -> None:
    after = world.successor(world.state(SCENARIO_1), ["move(rob1,library)"])
    assert world.true_atoms(after) == (
        "loc(book1,library)",
        "loc(book2,kitchen)",
        "loc(rob1,library)",
        "in_hand(rob1,book1)",
    )


def test_robot_and_adversary_act_together(world: World) -> None:
    after = world.successor(world.state(SCENARIO_1), ["move(rob1,library)", "exo_lock(library)"])
    assert world.satisfies(after, ["loc(rob1,library)", "locked(library)"])
    assert not world.executable(after, ["move(rob1,kitchen)"])


def test_contradicting_effects_make_a_compound_action_impossible(world: World) -> None:
    state = world.state(["loc(rob1,kitchen)", "loc(book1,kitchen)", "loc(book2,kitchen)"])
    both = ["pickup(rob1,book1)", "exo_move(book1,office1)"]
    assert all(world.executable(state, [action]) for action in both)
    assert not world.executable(state, both)
    with pytest.raises(NotExecutableError, match=r"effects of exo_move.*, pickup.* contradict"):
        world.successor(state, both)


def test_the_law_that_forbids_an_action_is_named(world: World) -> None:
    state = world.state(SCENARIO_1)
    law = "impossible move(rob1,office1) if loc(rob1,kitchen)"
    assert world.why_not(state, ["move(rob1,office1)"]) == law
    assert world.why_not(state, ["move(rob1,office2)"]) is None


def test_nothing_happens_without_actions(world: World) -> None:
    assert all(world.successors(state, ()) == (state,) for state in world.states())


def test_what_the_robot_sees(world: World) -> None:
    seen = world.visible(world.state([*SCENARIO_1, "locked(library)"]), "rob1")
    assert set(seen) == {
        "loc(rob1,kitchen)",
        *(f"-loc(rob1,{room})" for room in ("office1", "office2", "library")),
        "loc(book1,kitchen)",
        "loc(book2,kitchen)",
        "in_hand(rob1,book1)",
        "-in_hand(rob1,book2)",
        "locked(library)",
    }
    far = world.state(["loc(rob1,office1)", "loc(book1,library)", "loc(book2,library)"])
    assert "-loc(book1,office1)" in world.visible(far, "rob1")
    assert not {"locked(library)", "-locked(library)"} & set(world.visible(far, "rob1"))


def test_literals_and_truth(world: World) -> None:
    state = world.state(SCENARIO_1)
    literals = world.literals(state)
    assert len(literals) == len(world.fluents)
    assert all(world.holds(state, literal) for literal in literals)
    assert world.satisfies(state, literals)
    assert not world.holds(state, "locked(library)")
    with pytest.raises(UnknownFluentError, match=r"loc\(rob1,attic\) is not a fluent"):
        world.holds(state, "loc(rob1,attic)")


@pytest.mark.parametrize(
    ("literals", "message"),
    [
        (["loc(book3,kitchen)"], r"loc\(book3,kitchen\) is not a fluent"),
        (["locked(library)", "-locked(library)"], r"contradiction .*-locked\(library\)"),
        (
            [*SCENARIO_1, "loc(book2,office1)"],
            r"loc\(book2,kitchen\), loc\(book2,office1\) cannot be together: .*-loc\(book2,",
        ),
        ([*SCENARIO_1, "-loc(book1,kitchen)"], r"loc\(book1,kitchen\) if loc\(rob1,kitchen\), in"),
        (["loc(rob1,kitchen)", "loc(book1,kitchen)"], r"needs loc\(book2,kitchen\) or "),
    ],
)
def test_what_is_no_initial_state(world: World, literals: list[str], message: str) -> None:
    with pytest.raises(StateError, match=message):
        world.state(literals)


def test_an_unknown_action_is_named(world: World) -> None:
    with pytest.raises(UnknownActionError, match=r"fly\(rob1,kitchen\) is not an action"):
        world.successors(world.state(SCENARIO_1), ["fly(rob1,kitchen)"])
    with pytest.raises(UnknownActionError):
        world.forbidding(world.state(SCENARIO_1), ["fly(rob1,kitchen)"])


def test_several_outcomes_are_all_found_and_none_is_taken_for_the_one() -> None:
    world = world_of(parse_description(UNDETERMINED))
    state = world.state(["f", "g"])
    outcomes = {world.true_atoms(after) for after in world.successors(state, ["a"])}
    assert outcomes == {("f", "h", "p"), ("g", "h")}
    with pytest.raises(ValueError, match=r"a has several outcomes: "):
        world.successor(state, ["a"])


def test_a_defined_fluent_follows_and_cannot_be_given_otherwise() -> None:
    world = world_of(parse_description(UNDETERMINED))
    assert world.true_atoms(world.state(["f"])) == ("f", "p")
    for wrong in (["p"], ["f", "-p"]):
        with pytest.raises(StateError):
            world.state(wrong)
