"""Whether a goal is within reach, and the least of who knows the events: as by brute force."""

import copy
import pickle
from collections.abc import Mapping, Sequence
from functools import partial
from math import inf
from random import Random

import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from asp.language import Action, Literal, SourceError, parse_description
from testbed.search import BudgetError, Reach, as_it_is, least_knowing
from testbed.world import World, world_of
from tests import games
from tests.games import DOMAINS
from tests.literals import parsed
from tests.search.test_heuristic import DEPOT
from tests.world.test_world_random import HEADER, laws


def _reach(world: World, most: int = 5_000) -> Reach:
    return Reach(partial(as_it_is, world), most)


@pytest.mark.parametrize("name", DOMAINS)
def test_from_every_state_the_answer_is_that_of_an_exhaustive_search(name: str) -> None:
    world, goal = world_of(parse_description(DOMAINS[name].text)), parsed(DOMAINS[name].goal)
    states, reach = [*world.states()], _reach(world)
    Random(3).shuffle(states)
    answers = {state: reach(state, goal) for state in states}
    assert answers == {state: games.reaches(world, state, goal) for state in states}
    assert set(answers.values()) == {True, False}


@settings(max_examples=60)
@given(st.lists(laws(), min_size=1, max_size=9), st.data())
def test_in_a_random_world_too(drawn: list[str], data: st.DataObject) -> None:
    text = HEADER + "\n".join(f"  {law}" for law in drawn) + "\n"
    try:
        world = world_of(parse_description(text))
    except SourceError as error:  # a fluent defined through its own negation
        assume("defined through its own negation" not in str(error))
        raise
    literals = [sign + fluent for fluent in world.fluents for sign in ("", "-")]
    goal = parsed(data.draw(st.lists(st.sampled_from(literals), min_size=1, max_size=3)))
    costs = {action: data.draw(st.integers(0, 9)) for action in world.agent_actions}
    steps = data.draw(st.sets(st.integers(1, 5), max_size=3))
    events = dict.fromkeys(sorted(steps), world.exogenous_actions[0])
    reach = _reach(world)
    for state in world.states():
        assert reach(state, goal) == games.reaches(world, state, goal)
        if world.successors(state, ()):  # where nobody can wait there is no game
            _check_knowing(world, state, goal, costs, events)


def _check_knowing(
    world: World,
    state: int,
    goal: Sequence[Literal],
    costs: Mapping[str, int],
    events: Mapping[int, Action],
) -> None:
    """The least is that of going through all ways, None where there is none."""
    expected = games.least_knowing(world, state, goal, costs, events)
    found = least_knowing((world, state, goal), [*events.items()], costs, 5_000)
    assert (inf if found is None else found) == expected


@pytest.mark.parametrize("name", DOMAINS)
def test_the_least_of_who_knows_the_events(name: str) -> None:
    own, choose = DOMAINS[name], Random(7)
    world, goal = world_of(parse_description(own.text)), parsed(own.goal)
    stated = world.description.costs
    costs = stated if any(stated.values()) else dict.fromkeys(stated, 1)
    state = world.state(parsed(own.initial))
    for _ in range(25):
        steps = sorted(choose.sample(range(1, 5), choose.randrange(4)))
        events = {step: choose.choice(world.exogenous_actions) for step in steps}
        _check_knowing(world, state, goal, costs, events)


@pytest.mark.parametrize(
    ("step", "event", "least"),
    [
        # Undisturbed: ship the salt (5), sail for the silk (3), and ship it, too (5).
        (9, "silt(east)", 13),
        # The silk comes by itself, and who knows that waits for it.
        (1, "drift(silk,west)", 5),
        (6, "drift(silk,west)", 5),
        # At the third step all is shipped; who knows that loses no time.
        (2, "silt(west)", None),
        (3, "silt(west)", 13),
        # A crate that is being shipped does not drift.
        (1, "drift(salt,east)", 13),
    ],
)
def test_who_knows_the_future_makes_use_of_it(step: int, event: str, least: int | None) -> None:
    own = DOMAINS["harbour"]
    world, goal = world_of(parse_description(own.text)), parsed(own.goal)
    problem = world, world.state(parsed(own.initial)), goal
    events = [(step, Literal.parse(event))]
    assert least_knowing(problem, events, world.description.costs, 5_000) == least


def test_who_knows_the_future_waits_beside_what_is_impossible() -> None:
    world = world_of(parse_description(DOMAINS["harbour"].text))
    problem = world, world.state(parsed(DOMAINS["harbour"].initial)), parsed(["lies(silk,west)"])
    events = [*enumerate(parsed(["drift(silk,east)", "drift(silk,west)"]), start=1)]
    assert least_knowing(problem, events, world.description.costs, 5_000) == 0


def test_where_the_bound_strikes_nothing_is_known() -> None:
    own = DOMAINS["lanterns"]
    world, goal = world_of(parse_description(own.text)), parsed(["glows(red)", "-glows(red)"])
    start = world.state(())
    # Without cracks there are eight states, all of which a search has to look at.
    assert _reach(world, 8)(start, goal) is False
    assert _reach(world, 7)(start, goal) is None
    with pytest.raises(BudgetError):
        least_knowing((world, start, goal), [], {}, 7)


@pytest.mark.parametrize("most", [1, 3, 5])
def test_an_answer_does_not_depend_on_what_was_asked_before(most: int) -> None:
    own = DOMAINS["harbour"]
    world, goal = world_of(parse_description(own.text)), parsed(own.goal)
    states = [*world.initial_states()]
    reach = _reach(world, most)
    for order in (states, states[::-1]):
        other = _reach(world, most)
        for state in order:
            assert other(state, goal) == _reach(world, most)(state, goal) == reach(state, goal)


def test_a_long_way_is_found_from_few_states_in_any_order() -> None:
    world, choose = world_of(parse_description(DEPOT)), Random(5)
    goal = parsed(f"stands(c{n},b0)" for n in range(1, 7))
    starts = [
        world.state(parsed([f"stands(hauler,b{choose.randrange(8)})", *_far_crates(choose)]))
        for _ in range(4)
    ]
    # The number of missing literals alone leads nowhere within this bound.
    before, after = _reach(world, 250), _reach(world, 250)
    assert [before(start, goal) for start in starts] == [True] * 4
    assert [after(start, goal) for start in starts[::-1]] == [True] * 4


def _far_crates(choose: Random) -> list[str]:
    return [f"stands(c{n},b{choose.randrange(3, 8)})" for n in range(1, 7)]


def test_copies_answer_alike() -> None:
    own = DOMAINS["harbour"]
    world, goal = world_of(parse_description(own.text)), parsed(own.goal)
    reach = _reach(world)
    start = world.state(parsed(own.initial))
    assert reach(start, goal)
    for other in (copy.deepcopy(reach), pickle.loads(pickle.dumps(reach))):
        assert other(start, goal)
