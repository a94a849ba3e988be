"""The judge finds shortest plans, and says where there is none."""

import itertools

import numpy as np
import pytest

from asp.domains import level_text
from asp.language import analyse, ground_description
from testbed.environment import RandomGoal
from testbed.search import Narrowing, cheapest_plan
from testbed.world import World, load_world, world_of
from tests.literals import parsed
from tests.oracle import minimal_actions, minimal_units

DELIVERED = parsed(
    ["loc(book1,library)", "loc(book2,library)", "-in_hand(rob1,book1)", "-in_hand(rob1,book2)"]
)


@pytest.fixture(scope="module")
def office() -> World:
    return load_world("office")


def _after(world: World, state: int, plan: tuple[str, ...]) -> int:
    for action in plan:
        state = world.successor(state, (action,))
    return state


def test_the_published_problem_takes_its_six_actions(office: World) -> None:
    start = office.state(parsed(["loc(rob1,kitchen)", "in_hand(rob1,book1)", "loc(book2,kitchen)"]))
    assert cheapest_plan((office, start, DELIVERED)) == (
        "move(rob1,library)",
        "put_down(rob1,book1)",
        "move(rob1,kitchen)",
        "pickup(rob1,book2)",
        "move(rob1,library)",
        "put_down(rob1,book2)",
    )


def test_out_of_the_locked_library_for_both_books_takes_seventeen(office: World) -> None:
    start = office.state(
        parsed(["loc(rob1,library)", "locked(library)", "loc(book1,office1)", "loc(book2,office1)"])
    )
    assert minimal_actions(office, start, DELIVERED) == 17


def test_the_cheapest_plan_is_where_no_step_can_make_it_cheaper(office: World) -> None:
    costs = office.description.costs
    units = {
        state: minimal_units(office, state, DELIVERED, costs) for state in office.initial_states()
    }
    for state, least in units.items():
        plan = cheapest_plan((office, state, DELIVERED))
        assert plan is not None
        assert least is not None
        assert least <= sum(costs[action] for action in plan)
        ways = [
            costs[action] + further
            for action in office.agent_actions
            for after in office.successors(state, (action,))
            if (further := minimal_units(office, after, DELIVERED, costs)) is not None
        ]
        assert least == (0 if office.satisfies(state, DELIVERED) else min(ways))


def test_what_costs_nothing_counts_nothing(office: World) -> None:
    start = office.state(parsed(["loc(rob1,kitchen)", "loc(book1,kitchen)", "loc(book2,kitchen)"]))
    goal = parsed(["loc(rob1,library)"])
    free = {action: 0 if action.startswith("pickup") else 5 for action in office.agent_actions}
    assert minimal_units(office, start, goal, free) == 5
    assert (
        minimal_units(office, start, parsed(["loc(book1,kitchen)", "loc(book1,library)"]), free)
        is None
    )
    assert minimal_units(office, start, parsed(["loc(rob1,kitchen)"]), free) == 0


def test_nothing_to_do_and_nothing_to_be_done(office: World) -> None:
    start = office.state(parsed(["loc(rob1,kitchen)", "loc(book1,library)", "loc(book2,library)"]))
    assert cheapest_plan((office, start, DELIVERED)) == ()
    assert (
        cheapest_plan((office, start, parsed(["loc(book1,kitchen)", "loc(book1,library)"]))) is None
    )
    assert minimal_actions(office, start, parsed(["loc(rob1,kitchen)", "locked(library)"])) is None


def test_from_every_initial_state_the_plan_arrives_and_is_plausible(office: World) -> None:
    starts = office.initial_states()
    assert len(starts) == 192
    for start in starts:
        plan = cheapest_plan((office, start, DELIVERED))
        assert plan is not None
        assert office.satisfies(_after(office, start, plan), DELIVERED)
        neighbours = (
            minimal_actions(office, after, DELIVERED)
            for action in office.agent_actions
            for after in office.successors(start, (action,))
        )
        best = min(length for length in neighbours if length is not None)
        assert len(plan) == (0 if office.satisfies(start, DELIVERED) else best + 1)


def test_no_shorter_sequence_of_actions_does_it(office: World) -> None:
    start = office.state(parsed(["loc(rob1,kitchen)", "in_hand(rob1,book1)", "loc(book2,library)"]))
    plan = cheapest_plan((office, start, DELIVERED))
    assert plan is not None
    for shorter in itertools.product(office.agent_actions, repeat=len(plan) - 1):
        states = {start}
        for action in shorter:
            states = {after for s in states for after in office.successors(s, (action,))}
        assert not any(office.satisfies(state, DELIVERED) for state in states)


@pytest.mark.parametrize(
    "patterns", [parsed(["loc(object,room)"]), parsed(["loc(object,room)", "loc(robot,room)"])]
)
def test_a_narrowed_domain_has_the_same_least(patterns: list[str]) -> None:
    source, signature = analyse(level_text(3, 1, 1, ((3, 1),))[0])
    description = ground_description(source, signature, "level")
    world, narrowing = world_of(description), Narrowing(source, signature, description.name)
    draw = RandomGoal(world, parsed(patterns), description.sorts)
    random = np.random.default_rng(1)
    states = world.initial_states()
    for number in random.permutation(len(states))[:60]:
        state = states[number]
        goal = draw(state, random)
        problem = narrowing.problem(world.true_atoms(state), goal)
        assert minimal_actions(*problem) == minimal_actions(world, state, goal)
        costs = {action: 1 + len(action) % 7 for action in world.agent_actions}
        assert minimal_units(*problem, costs) == minimal_units(world, state, goal, costs)


def test_a_narrowed_domain_says_what_is_out_of_reach() -> None:
    source, signature = analyse(level_text(3, 1, 1, ((3, 1),))[0])
    description = ground_description(source, signature, "level")
    narrowing = Narrowing(source, signature, description.name)
    start = parsed(f"loc({thing},room1)" for thing in ("rob1", "object1", "object2", "object3"))
    impossible = parsed(["in_hand(rob1,object1)", "loc(rob1,room1)", "loc(object1,room2)"])
    assert minimal_actions(*narrowing.problem(start, impossible)) is None
    assert minimal_actions(*narrowing.problem(start, start)) == 0
