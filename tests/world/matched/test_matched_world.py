"""The world that matches its laws is the world of their instances, domain by domain."""

from collections.abc import Iterable
from itertools import product

import numpy as np
import pytest

from asp import parse_description
from asp.domains import level_text
from asp.language import analyse, ground_description, read_domain
from asp.refinement import load
from testbed.world import (
    NotExecutableError,
    StateError,
    UnknownActionError,
    UnknownFluentError,
    World,
    world_of,
)
from tests.world.test_world import UNDETERMINED

OFFICE = read_domain("office")[1]
SMALL = ((2, 1, 2, ((1, 1),)), (2, 1, 2, ((1, 2),)), (3, 1, 1, ((1, 2), (1, 1))))


Size = tuple[int, int, int, tuple[tuple[int, int], ...]]


def level(size: Size) -> tuple[World, World]:
    """Both worlds of the physics of a level."""
    coarse, fine = level_text(*size)
    refinement = load(coarse, "level.al", fine, "level.fine")
    weak, signature = refinement.weak, refinement.weak_signature
    return world_of(ground_description(weak, signature, "level")), world_of(refinement)


def compounds(world: World) -> list[tuple[str, ...]]:
    robot = [(), *((action,) for action in world.agent_actions)]
    adversary = [(), *((action,) for action in world.exogenous_actions)]
    return [one + other for one, other in product(robot, adversary)]


def agree(
    ground: World, matched: World, states: Iterable[int], asked: list[tuple[str, ...]]
) -> int:
    """The number of transitions, which are the same, with the same reasons against them."""
    found = 0
    for state, compound in product(states, asked):
        after = matched.successors(state, compound)
        assert after == ground.successors(state, compound)
        assert matched.executable(state, compound) == bool(after)
        assert matched.why_not(state, compound) == ground.why_not(state, compound)
        found += len(after)
    return found


@pytest.mark.parametrize("size", SMALL)
def test_small_levels_have_the_same_diagram(size: Size) -> None:
    ground, matched = level(size)
    states = list(ground.states())
    asked = compounds(ground)
    assert matched.fluents == ground.fluents
    assert agree(ground, matched, states, asked) > len(states)
    assert all(map(matched.is_state, states))
    for state in ground.initial_states():
        assert matched.state(ground.true_atoms(state)) == state
        assert matched.literals(state) == ground.literals(state)
        assert matched.true_atoms(state) == ground.true_atoms(state)


def test_the_office_has_the_same_diagram_and_is_seen_alike() -> None:
    ground, matched = world_of(parse_description(OFFICE)), world_of(analyse(OFFICE)[0])
    states = list(ground.states())
    asked = compounds(ground)
    assert agree(ground, matched, states[::17], asked) > 250
    assert agree(ground, matched, states, [(action,) for action in ground.agent_actions]) > 500
    for state in states:
        assert matched.visible(state, "rob1") == ground.visible(state, "rob1")
    assert sum(map(matched.is_state, range(1 << len(ground.fluents)))) == len(states) == 430


def test_walks_through_a_level_of_four_rooms_agree() -> None:
    ground, matched = level((4, 2, 2, ((3, 3),)))
    random = np.random.default_rng(4)
    events = [()] * 20 + [(event,) for event in ground.exogenous_actions]
    for _ in range(4):
        state = matched.state(_somewhere(ground, random))
        for _ in range(10):
            robot = [(a,) for a in ground.agent_actions if ground.executable(state, (a,))]
            one = robot[int(random.integers(len(robot)))]
            tries = [one + events[int(random.integers(len(events)))] for _ in range(8)]
            agree(ground, matched, [state], tries)
            after = [s for compound in tries for s in matched.successors(state, compound)]
            state = after[0] if after else state
            assert matched.is_state(state)
            assert ground.is_state(state)


def _somewhere(world: World, random: np.random.Generator) -> list[str]:
    sorts = world.description.sorts
    cells = {thing: random.choice(sorts["cell"]) for thing in (*sorts["object"], "rob1")}
    whole = {part: part.rpartition("_")[0] for part in sorts["part"]}
    return [
        *(f"fine_loc({part},{cells[whole[part]]})" for part in sorts["part"]),
        f"fine_loc(rob1,{cells['rob1']})",
    ]


def test_every_part_goes_along_and_the_coarse_fluents_follow() -> None:
    _, world = level((2, 1, 2, ((1, 2),)))
    held = ("fine_loc(rob1,room1_2)", "fine_in_hand(rob1,object1_2)")
    state = world.state(held)
    assert world.true_atoms(state) == (
        "fine_loc(object1_1,room1_2)",
        "fine_loc(object1_2,room1_2)",
        "fine_loc(rob1,room1_2)",
        "fine_in_hand(rob1,object1_2)",
        "loc(object1,room1)",
        "loc(rob1,room1)",
        "in_hand(rob1,object1)",
    )
    after = world.successor(state, ["fine_move(rob1,room2_1)"])
    assert world.satisfies(after, ["loc(object1,room2)", "-loc(object1,room1)"])
    assert world.satisfies(after, ["fine_loc(object1_1,room2_1)", "in_hand(rob1,object1)"])


def test_several_outcomes_and_none_are_told_apart() -> None:
    world = world_of(analyse(UNDETERMINED)[0])
    state = world.state(["f", "g"])
    assert {world.true_atoms(s) for s in world.successors(state, ["a"])} == {
        ("f", "h", "p"),
        ("g", "h"),
    }
    with pytest.raises(ValueError, match=r"a has several outcomes: "):
        world.successor(state, ["a"])
    office = world_of(analyse(OFFICE)[0])
    state = office.state(["loc(rob1,kitchen)", "loc(book1,kitchen)", "loc(book2,kitchen)"])
    with pytest.raises(NotExecutableError, match=r"effects of exo_move.*, pickup.* contradict"):
        office.successor(state, ["pickup(rob1,book1)", "exo_move(book1,office1)"])


@pytest.mark.parametrize(
    ("literals", "message"),
    [
        (["loc(book3,kitchen)"], r"loc\(book3,kitchen\) is not a fluent"),
        (["locked(library)", "-locked(library)"], r"contradiction .*-locked\(library\)"),
        (
            ["loc(book2,kitchen)", "loc(book2,office1)"],
            r"loc\(book2,kitchen\), loc\(book2,office1\) cannot be together: .*-loc\(book2,",
        ),
        (["loc(rob1,kitchen)", "loc(book1,kitchen)"], r"needs loc\(book2,kitchen\) or "),
    ],
)
def test_what_is_no_initial_state(literals: list[str], message: str) -> None:
    world = world_of(analyse(OFFICE)[0])
    with pytest.raises(StateError, match=message):
        world.state(literals)


def test_literals_are_together_unless_they_contradict_each_other() -> None:
    world = world_of(analyse(OFFICE)[0])
    world.check_together(["loc(book1,kitchen)", "-locked(library)"])
    with pytest.raises(StateError, match="cannot be together"):
        world.check_together(["in_hand(rob1,book1)", "in_hand(rob1,book2)"])


def test_unknown_names_are_told() -> None:
    world = world_of(analyse(OFFICE)[0])
    with pytest.raises(UnknownFluentError, match=r"loc\(rob1,attic\) is not a fluent"):
        world.holds(0, "loc(rob1,attic)")
    with pytest.raises(UnknownActionError, match=r"fly\(rob1,kitchen\) is not an action"):
        world.successors(0, ["fly(rob1,kitchen)"])
