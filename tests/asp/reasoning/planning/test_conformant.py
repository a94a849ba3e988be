"""Plans in descriptions whose actions have several outcomes, against a search in the world."""

from itertools import product

import pytest
from hypothesis import assume, event, given, settings
from hypothesis import strategies as st

import asp
from asp.language import Action, Description, Literal
from asp.reasoning import knowledge
from asp.reasoning.planning import (
    IncrementalConformantPlanner,
    IncrementalPlanner,
    ReferencePlanner,
    reference_conformant_planner,
)
from asp.reasoning.successors import Transitions
from testbed.world import World, world_of
from tests.asp.reasoning.branching import CRATES, DEFINED, DIE, DOOR, INERTIAL, descriptions
from tests.literals import parsed

LIMIT = 3
GOALS = st.lists(
    st.builds("{}{}".format, st.sampled_from(["", "-"]), st.sampled_from(INERTIAL + DEFINED)),
    min_size=1,
    max_size=2,
    unique_by=lambda literal: literal.strip("-"),
).map(parsed)


def _optimistic(world: World, state: int, plan: tuple[Action, ...]) -> set[int]:
    """The states that a plan may lead to."""
    reached = {state}
    for action in plan:
        reached = {after for each in reached for after in world.successors(each, (action,))}
    return reached


def _conformant(world: World, state: int, plan: tuple[Action, ...]) -> set[int]:
    """The same where every action is possible whatever the outcomes were; else none."""
    reached = {state}
    for action in plan:
        after = [world.successors(each, (action,)) for each in reached]
        reached = {each for some in after for each in some} if all(after) else set()
    return reached


def _first(world: World, state: int, goal: tuple[Literal, ...], conformant: bool) -> object:
    """The first shortest plan of all sequences of actions."""
    for length in range(1, LIMIT + 1):
        for plan in product(world.agent_actions, repeat=length):
            ends = (_conformant if conformant else _optimistic)(world, state, plan)
            good = [world.satisfies(end, goal) for end in ends]
            if good and (all(good) if conformant else any(good)):
                return plan
    return None


@settings(max_examples=60)
@given(description=descriptions(), goal=GOALS, draw=st.data())
def test_all_planners_find_the_first_shortest_plan(
    description: Description, goal: tuple[Literal, ...], draw: st.DataObject
) -> None:
    world, known = world_of(description), knowledge("random", description.source)
    states = [state for state in world.states() if not world.satisfies(state, goal)]
    assume(states)
    state = draw.draw(st.sampled_from(states))
    true = frozenset(world.true_atoms(state))
    plans = IncrementalPlanner(description.source, "random.al")
    transitions = Transitions(known.program, description.fluents, known.deterministic)
    incremental = IncrementalConformantPlanner(description.agent_actions, transitions, plans)
    reference = reference_conformant_planner(known)
    optimistic = _first(world, state, goal, conformant=False)
    conformant = _first(world, state, goal, conformant=True)
    assert plans.shortest(true, goal, LIMIT) == optimistic
    assert ReferencePlanner(known).shortest(true, goal, LIMIT) == optimistic
    assert reference.shortest([true], goal, LIMIT) == conformant
    assert incremental.shortest([true], goal, LIMIT) == conformant
    if known.deterministic:
        assert optimistic == conformant
    event(f"both: {optimistic == conformant}")


@settings(max_examples=40)
@given(
    description=descriptions(),
    goal=GOALS,
    numbers=st.lists(st.integers(0, 2), min_size=1, max_size=3),
    draw=st.data(),
)
def test_whether_a_plan_succeeds(
    description: Description, goal: tuple[Literal, ...], numbers: list[int], draw: st.DataObject
) -> None:
    world, known = world_of(description), knowledge("random", description.source)
    states = list(world.states())
    assume(states)
    state = draw.draw(st.sampled_from(states))
    true = frozenset(world.true_atoms(state))
    plan = tuple(world.agent_actions[number] for number in numbers)
    plans = IncrementalPlanner(description.source, "random.al")
    heads = [plan[:length] for length in range(1, len(plan) + 1)]
    ends = [[world.satisfies(s, goal) for s in _conformant(world, state, head)] for head in heads]
    conformant = reference_conformant_planner(known)
    assert conformant.succeeds([true], goal, plan) == any(end and all(end) for end in ends)
    ends = [[world.satisfies(s, goal) for s in _optimistic(world, state, head)] for head in heads]
    assert plans.succeeds(true, goal, plan) == any(map(any, ends))
    assert ReferencePlanner(known).succeeds(true, goal, plan) == any(map(any, ends))


@pytest.mark.parametrize(
    ("text", "state", "goal", "optimistic", "conformant"),
    [
        (DIE, "up(one), up(two), up(three)", "up(two), -up(one)", ("throw",), None),
        (DOOR, "shut, loose", "outside", ("pull", "leave"), None),
        (
            CRATES,
            "high(large), whole(large)",
            "-high(large)",
            ("tip(large)",),
            ("tie(large)", "lower(large)"),
        ),
        (CRATES, "high(small), whole(small)", "tilted(small)", ("tip(small)",), ("tip(small)",)),
    ],
)
def test_a_conformant_plan_takes_no_chances(
    text: str,
    state: str,
    goal: str,
    optimistic: tuple[str, ...],
    conformant: tuple[str, ...] | None,
) -> None:
    own = asp.Domain(text, "own.al")
    assert own.plan(state, goal) == optimistic
    assert own.plan(state, goal, limit=6, plans="conformant") == conformant
