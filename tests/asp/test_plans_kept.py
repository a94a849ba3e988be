"""Plans looked for in a part of the domain are the first shortest plans of the whole domain."""

from __future__ import annotations

import random

import pytest

from asp.description import Description
from asp.kept.independence import Independence, symmetric_pairs
from asp.kept.plans import Plans
from asp.loading import analyse, parse_description, read_domain
from testbed.environment.world import World

OFFICE = read_domain("office")[1]
FOUR_BOOKS = OFFICE.replace("{book1, book2}", "{book1, book2, book3, book4}")
# A shelf that can fall on the robot: what is true of a book changes something else.
ALARM = OFFICE.replace(
    "inertial locked(secure_room).", "inertial locked(secure_room).\n  inertial alarm."
).replace("  % State constraints.", "  alarm if in_hand(R, O), loc(O, library).\n")


def _first_shortest(
    world: World, state: int, goal: tuple[str, ...], limit: int
) -> tuple[str, ...] | None:
    """The first plan in the order of declaration, by layers of a breadth-first search."""
    layer: dict[int, tuple[str, ...]] = {state: ()}
    seen = {state}
    for _ in range(limit):
        following: dict[int, tuple[str, ...]] = {}
        for now, plan in sorted(layer.items(), key=lambda item: _rank(world, item[1])):
            for action in world.agent_actions:
                for after in world.successors(now, (action,)):
                    if after not in seen and after not in following:
                        following[after] = (*plan, action)
        reached = [plan for after, plan in following.items() if world.satisfies(after, goal)]
        if reached:
            return min(reached, key=lambda plan: _rank(world, plan))
        seen |= following.keys()
        layer = following
    return None


def _rank(world: World, plan: tuple[str, ...]) -> list[int]:
    return [world.agent_actions.index(action) for action in plan]


def _independence(text: str) -> Independence:
    source, signature = analyse(text, "office.al")
    return Independence(parse_description(text, "office.al"), source, signature)


def _some_goal(description: Description, draw: random.Random) -> tuple[str, ...]:
    fluents = [fluent for fluent in description.fluents if not fluent.startswith("locked")]
    chosen = draw.sample(fluents, draw.choice([1, 1, 2]))
    return tuple(draw.choice(["", "-"]) + fluent for fluent in chosen)


@pytest.mark.parametrize("text", [OFFICE, FOUR_BOOKS, ALARM], ids=["office", "books", "alarm"])
def test_the_plan_is_the_first_shortest_of_the_whole_domain(text: str) -> None:
    draw = random.Random(7)
    description = parse_description(text, "office.al")
    world, plans = World(description), Plans(text, "office.al")
    states = list(world.initial_states())
    for _ in range(60):
        state, goal = draw.choice(states), _some_goal(description, draw)
        if not world.satisfies(state, goal):
            found = plans.shortest(frozenset(world.true_atoms(state)), goal, 9)
            assert found == _first_shortest(world, state, goal, 9), (world.true_atoms(state), goal)


def test_books_can_be_left_out_but_not_rooms_or_the_robot() -> None:
    assert _independence(OFFICE).candidates == {"book1", "book2"}


def test_a_book_that_changes_something_else_cannot_be_left_out() -> None:
    assert _independence(ALARM).candidates == set()


def test_a_book_in_the_hand_stands_in_the_way() -> None:
    independence = _independence(OFFICE)
    state = {"loc(rob1,kitchen)", "loc(book1,kitchen)", "loc(book2,office1)"}
    assert independence.droppable(state, ["loc(book1,library)"]) == {"book2"}
    held = state | {"in_hand(rob1,book2)"}
    assert independence.droppable(held, ["loc(book1,library)"]) == set()


def test_what_the_goal_wants_and_is_so_stays_so_without_touching_it() -> None:
    state = {"loc(rob1,kitchen)", "loc(book1,kitchen)", "loc(book2,library)"}
    goal = ["loc(book1,library)", "loc(book2,library)", "-in_hand(rob1,book2)"]
    assert _independence(OFFICE).droppable(state, goal) == {"book2"}


def test_neighbours_are_symmetric_where_state_and_goal_say_the_same_of_both() -> None:
    classes = [("a", "b", "c")]
    state = {"loc(a,x)", "loc(b,x)", "loc(c,y)", "loc(robot,x)"}
    assert symmetric_pairs(classes, state, {"loc(a,z)", "loc(b,z)"}) == (("a", "b"),)
    assert symmetric_pairs(classes, state, {"loc(a,z)"}) == ()
