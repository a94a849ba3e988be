"""Tables of coarse games against the game itself: every state, every answer, every event."""

from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from asp import load_description, parse_description
from testbed.environment import ADVERSARY, ROBOT, Core, EventRules, Rules
from testbed.environment.observation import observe
from testbed.environment.rules import Situation
from testbed.environment.tables import ENDINGS, TableError, Tables
from testbed.office_v0 import make_core
from testbed.world import World, world_of
from tests.environment.coarse import DOMAINS, random_world
from tests.literals import parsed
from tests.world.test_world_random import laws


def _worlds() -> dict[str, tuple[World, list[str]]]:
    own = {
        name: (world_of(parse_description(text)), goal) for name, (text, goal) in DOMAINS.items()
    }
    return own | {"office": (world_of(load_description("office")), ["loc(book1,library)"])}


WORLDS = _worlds()
RANDOM = [np.random.default_rng(seed).bit_generator.state for seed in range(12)]


def _check(world: World, rules: Rules) -> None:
    """The tables of all states against a core that is put into each position."""
    states = tuple(world.states())
    core, tables = Core(world, rules, states), Tables(Core(world, rules, states))
    core.reset(0)
    _, random = core.snapshot()
    tables.make_all(states)
    assert tables.complete
    assert tables.states == list(states)
    for number, state in enumerate(states):
        for answered in (False, True):
            before = Situation("", 1, state, rules.goal, goal_holds=False if answered else None)
            core.restore((before, random))
            _check_position(core, tables, 2 * number + answered)


def _check_position(core: Core, tables: Tables, position: int) -> None:
    before = core.snapshot()
    fluents, robot = len(core.world.fluents), len(core.robot_actions)
    seen = observe(core, ROBOT, None)["observation"]
    assert np.array_equal(tables.robot_sees[position >> 1, :fluents], seen)
    for own, answer in enumerate(core.robot_actions):
        shown = observe(core, ADVERSARY, answer)
        entries = tables.adversary_sees[position >> 1, own, : fluents + robot]
        assert np.array_equal(entries, shown["observation"])
        mask = tables.legal[position >> 1, own, : len(core.adversary_actions)]
        assert np.array_equal(mask, shown["action_mask"])
        for other, event in enumerate(core.adversary_actions):
            following = tables.following[position, own, other]
            assert (following >= 0) == bool(mask[other])
            if following < 0:
                place = np.ravel_multi_index((position, own, other), tables.following.shape)
                assert event in tables.why_not(int(place))
                continue
            assert _followed(tables, position, own, other) == _played(core, answer, event)
            core.restore(before)
            core.advance(answer, event)
            ending = core.situation.ending
            assert ENDINGS.get(int(tables.ending[position, own])) == ending
            core.restore(before)


def _followed(tables: Tables, position: int, own: int, other: int) -> set[tuple[int, bool]]:
    """The states and whether `finish` was answered, as the tables have it."""
    place = np.ravel_multi_index((position, own, other), tables.following.shape)
    first = int(tables.following[position, own, other])
    found = tables.several.get(int(place), (first,))
    assert first in found
    return {(tables.states[each >> 1], bool(each & 1)) for each in found}


def _played(core: Core, answer: object, event: object) -> set[tuple[int, bool]]:
    """The same by play, from as many seeds as it takes to see all that may follow."""
    now, _ = core.snapshot()
    found = set()
    for random in RANDOM:
        core.restore((now, random))
        core.advance(answer, event)  # type: ignore[arg-type]
        after = core.situation
        found.add((after.state, after.goal_holds is False and after.ending is None))
        if core.random_state == random:  # where nothing is drawn, every seed gives the same
            break
    return found


@pytest.mark.parametrize("feedback", [True, False])
@pytest.mark.parametrize("thinking", [True, False])
@pytest.mark.parametrize("name", DOMAINS)
def test_they_are_the_game(name: str, thinking: bool, feedback: bool) -> None:
    world, goal = WORLDS[name]
    rules = Rules(
        goal=parsed(goal), steps=5, goal_feedback=feedback, exogenous_while_thinking=thinking
    )
    _check(world, rules)


@settings(max_examples=40, deadline=None)
@given(st.lists(laws(), min_size=1, max_size=7))
def test_they_are_the_game_of_random_descriptions(drawn: list[str]) -> None:
    _check(random_world(drawn), Rules(goal=parsed(["f"])))


@pytest.mark.parametrize("name", WORLDS)
def test_they_are_made_as_they_are_needed(name: str) -> None:
    world, goal = WORLDS[name]
    start = world.initial_states()[-1]
    tables = Tables(Core(world, Rules(goal=parsed(goal)), (start,)))
    assert (tables.states, tables.complete) == ([start], False)
    tables.make([0])
    assert tables.made.sum() == 1
    known = {
        start,
        *(s for event in (*world.exogenous_actions,) for s in world.successors(start, [event])),
    }
    assert known <= set(tables.states)
    whole = Tables(Core(world, Rules(goal=parsed(goal)), (start,)))
    whole.make_all([start])
    while not tables.complete:
        tables.make(range(len(tables.states)))
    assert set(tables.states) == set(whole.states)


@pytest.mark.parametrize(
    "options",
    [
        {"level": "L1"},
        {"adversary": {"budget": 3}},
        {"adversary": {"cooldown": 3}},
        {"adversary": {"per_object": {"book": 1}}},
        {"rewards": {"shaping": 0.1}},
        {"rewards": {"adversary": "waste"}},
    ],
)
def test_there_are_none_of_a_game_that_they_cannot_hold(options: dict[str, Any]) -> None:
    with pytest.raises(TableError):
        Tables(make_core(**options))


@pytest.mark.parametrize("name", DOMAINS)
@pytest.mark.parametrize("fair", [True, False])
def test_they_hold_which_events_are_allowed_and_fair(name: str, fair: bool) -> None:
    world, goal = WORLDS[name]
    event = world.exogenous_actions[0].name
    bounds = EventRules(fair=fair, events=(event,))
    _check(world, Rules(goal=parsed(goal), steps=5, adversary=bounds))
