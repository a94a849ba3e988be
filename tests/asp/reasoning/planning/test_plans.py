"""Which of several plans is taken, and when an earlier activity is started again."""

from collections.abc import Sequence

import pytest

from asp import load_description
from asp.solving import first_model, select
from testbed.world import World, world_of
from tests.asp.reasoning.stories import (
    CART,
    GATE_OPEN,
    GATE_SHUT,
    GOAL,
    SELECTED,
    STOPPED,
    activity,
    intending,
    lines,
)
from tests.asp.theories.preferring import ground_story

_OFFICE_GOAL = {
    "loc(book1,library)": "true",
    "loc(book2,library)": "true",
    "in_hand(rob1,book1)": "false",
    "in_hand(rob1,book2)": "false",
}


def _planning(
    rules: str, now: int, length: int, domain: str = CART
) -> tuple[str, tuple[str, ...]] | None:
    """The intended action and the plan of the preferred answer set."""
    constants = {"n": now + 1 + length, "max_name": 3, "max_len": length}
    model = first_model(ground_story(domain, "planning", [rules, intending(now)], constants))
    if model is None:
        return None
    ((action, _),) = select(model, "intended_action", 2)
    steps = sorted((index.number, str(step)) for _, index, step in select(model, "plan", 3))
    return str(action), tuple(step for _, step in steps)


def _shortest_plans(world: World, start: int, goal: Sequence[str]) -> list[tuple[str, ...]]:
    """Every shortest plan, found by search over the world, in the order of declaration."""
    reached: list[tuple[int, tuple[str, ...]]] = [(start, ())]
    while True:
        done = [plan for state, plan in reached if world.satisfies(state, goal)]
        if done:
            return done
        reached = [
            (world.successor(state, [action]), (*plan, action))
            for state, plan in reached
            for action in world.agent_actions
            if world.executable(state, [action]) and world.successors(state, [action])
        ]


def test_of_several_shortest_plans_the_first_in_the_order_of_declaration_is_taken() -> None:
    goal = "goal(at(right),true). goal(lit,true)."
    # open is declared before go, go before switch_on.
    assert _planning(lines(GATE_SHUT, goal, SELECTED), 1, 2) is None
    assert _planning(lines(GATE_SHUT, goal, SELECTED), 1, 3) == (
        "start(1)",
        ("open", "go(right)", "switch_on"),
    )


@pytest.mark.parametrize(
    "start",
    [
        ("loc(rob1,kitchen)", "in_hand(rob1,book1)", "loc(book2,kitchen)"),
        ("loc(rob1,kitchen)", "loc(book1,kitchen)", "loc(book2,kitchen)"),
        ("loc(rob1,library)", "loc(book1,office2)", "loc(book2,library)"),
        ("loc(rob1,office2)", "in_hand(rob1,book2)", "loc(book1,library)", "locked(library)"),
        ("loc(rob1,library)", "in_hand(rob1,book1)", "loc(book2,library)", "locked(library)"),
    ],
)
def test_a_plan_is_the_first_of_the_shortest_ones_that_a_search_finds(
    start: tuple[str, ...],
) -> None:
    world = world_of(load_description("office"))
    state = world.state(start)
    literals = [atom if truth == "true" else "-" + atom for atom, truth in _OFFICE_GOAL.items()]
    known = [
        f"obs({literal.removeprefix('-')},{'false' if literal.startswith('-') else 'true'},0)."
        for literal in world.literals(state)
    ]
    goal = [f"goal({atom},{truth})." for atom, truth in _OFFICE_GOAL.items()]
    plans = _shortest_plans(world, state, literals)
    length = len(plans[0])
    story = lines(*known, *goal, SELECTED)
    assert _planning(story, 1, length - 1, "office") is None
    assert _planning(story, 1, length, "office") == ("start(1)", plans[0])


def test_an_earlier_activity_is_restarted_with_its_own_plan() -> None:
    story = lines(GATE_SHUT, GOAL, STOPPED, activity(1, "open", "go(right)"))
    assert _planning(story, 3, 1) is None
    assert _planning(story, 3, 2) == ("start(1)", ("open", "go(right)"))


def test_a_new_activity_is_built_where_no_earlier_one_has_the_plan() -> None:
    story = lines(GATE_OPEN, GOAL, STOPPED, activity(1, "open", "go(right)"))
    assert _planning(story, 3, 1) == ("start(2)", ("go(right)",))
