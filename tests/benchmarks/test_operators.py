"""The operators that peers plan with have the transitions of the compiled world."""

from __future__ import annotations

import random

import pytest

from asp.loading import parse_description
from benchmarks.offices import office
from benchmarks.operators import Encoding
from benchmarks.search import Search
from testbed.environment.world import World

OFFICES = (
    office(),
    office(books=1, rooms=3),
    office(books=3, rooms=5, shape="tree", secure=2),
    office(books=2, rooms=6, shape="grid"),
)


@pytest.mark.parametrize("source", OFFICES)
def test_operators_lead_where_actions_lead(source: str) -> None:
    description = parse_description(source, "office.al")
    world, search = World(description), Search(Encoding(description))
    rng = random.Random(1)
    state = next(s for s in world.initial_states())
    for _ in range(150):
        expected = {
            action: search.state(world.true_atoms(world.successor(state, [action])))
            for action in world.agent_actions
            if world.executable(state, [action])
        }
        found = list(search.successors(search.state(world.true_atoms(state))))
        assert len(found) == len(expected)
        assert dict(found) == expected
        anything = (*world.agent_actions, *world.exogenous_actions)
        state = world.successor(
            state, [rng.choice([a for a in anything if world.executable(state, [a])])]
        )
