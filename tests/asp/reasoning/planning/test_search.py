"""Bounds on plans are admissible, and exact where the space is; nothing on the way is left out."""

from __future__ import annotations

import random
from collections.abc import Iterator

import pytest

from asp.language import parse_description
from asp.reasoning.planning import Encoding
from asp.reasoning.planning.large.search import Spaces
from benchmarks.offices import office
from testbed.world import World, world_of

LIMIT = 12
EVERYTHING = 2**20
SOURCES = (office(), office(books=1, rooms=5, shape="grid"), office(books=2, rooms=4, secure=2))


class StopError(Exception):
    """Raised where expansions are spent."""


class _Layers:
    """How far every state is from one state, by the compiled world."""

    def __init__(self, world: World, state: int) -> None:
        self.world = world
        self.distance = {state: 0}
        self.edges: list[tuple[int, str, int]] = []
        waiting = [state]
        for now in waiting:  # grows while it is read
            for action in world.agent_actions:
                for after in world.successors(now, (action,)):
                    self.edges.append((now, action, after))
                    if after not in self.distance:
                        self.distance[after] = self.distance[now] + 1
                        waiting.append(after)

    def length(self, goal: tuple[str, ...]) -> int | None:
        satisfying = (d for s, d in self.distance.items() if self.world.satisfies(s, goal))
        return min(satisfying, default=None)

    def steps(self, goal: tuple[str, ...], length: int) -> list[set[str]]:
        """The actions of all shortest plans, by step."""
        left = {
            s for s, d in self.distance.items() if d == length and self.world.satisfies(s, goal)
        }
        found: list[set[str]] = []
        for step in reversed(range(length)):
            before = [
                (s, a) for s, a, after in self.edges if after in left and self.distance[s] == step
            ]
            left = {s for s, _ in before}
            found.append({a for _, a in before})
        return found[::-1]


def _questions(
    source: str, number: int
) -> Iterator[tuple[_Layers, frozenset[str], tuple[str, ...]]]:
    description = parse_description(source, "office.al")
    world, draw = world_of(description), random.Random(3)
    states = list(world.initial_states())
    for _ in range(number):
        state = draw.choice(states)
        literals = draw.sample(description.fluents, draw.choice([1, 2]))
        goal = tuple(draw.choice(["", "", "-"]) + fluent for fluent in literals)
        yield _Layers(world, state), frozenset(world.true_atoms(state)), goal


def _nothing(_expansions: int) -> None:
    """No reason to stop."""


@pytest.mark.parametrize("source", SOURCES)
def test_in_the_whole_space_length_and_steps_are_exact(source: str) -> None:
    spaces = Spaces(Encoding(parse_description(source, "office.al")), EVERYTHING)
    assert spaces.exact
    for layers, state, goal in _questions(source, 40):
        bounds = spaces.bounds(state, goal)
        assert bounds is not None
        length = bounds.least(None, _nothing)
        assert length == layers.length(goal)
        if length is not None:
            assert [set(step) for step in bounds.steps(length, _nothing)] == layers.steps(
                goal, length
            )


@pytest.mark.parametrize("most_states", [1, 10, 40, 90])
@pytest.mark.parametrize("source", SOURCES)
def test_in_smaller_spaces_bounds_are_admissible(source: str, most_states: int) -> None:
    spaces = Spaces(Encoding(parse_description(source, "office.al")), most_states)
    assert not spaces.exact
    for layers, state, goal in _questions(source, 25):
        bounds = spaces.bounds(state, goal)
        assert bounds is not None
        exact, least = layers.length(goal), bounds.least(LIMIT, _nothing)
        if exact is not None and exact <= LIMIT:
            assert least is not None
            assert least <= exact
            allowed = bounds.steps(exact, _nothing)
            for some, all_of_them in zip(layers.steps(goal, exact), allowed, strict=True):
                assert some <= all_of_them


def test_smaller_spaces_still_tell_something() -> None:
    source = office(books=3, rooms=8)
    spaces = Spaces(Encoding(parse_description(source, "office.al")), 2_000)
    state = ["loc(rob1,library)", *(f"loc(book{n},office1)" for n in (1, 2, 3))]
    bounds = spaces.bounds(frozenset(state), ["loc(book1,library)"])
    assert bounds is not None
    assert bounds.least(60, _nothing) == 15  # there, picked up, and back


def test_a_search_that_was_stopped_goes_on_where_it_was() -> None:
    spaces = Spaces(Encoding(parse_description(SOURCES[0], "office.al")), EVERYTHING)
    state = ["loc(rob1,library)", "loc(book1,office1)", "loc(book2,office1)", "locked(library)"]
    goal = ["loc(book1,library)", "loc(book2,library)", "-in_hand(rob1,book2)"]
    whole, stopped = (spaces.bounds(frozenset(state), goal) for _ in range(2))
    assert whole is not None
    assert stopped is not None
    layers = 0

    def once(_expansions: int) -> None:
        nonlocal layers
        layers += 1
        if layers % 2:
            raise StopError

    found = None
    while found is None:
        try:
            found = stopped.least(60, once)
        except StopError:
            assert layers < 60
    assert found == whole.least(60, _nothing)
    assert layers == 2 * found
    assert stopped.steps(found, _nothing) == whole.steps(found, _nothing)


@pytest.mark.parametrize("most_states", [10, 90])
def test_having_looked_further_changes_no_bound(most_states: int) -> None:
    spaces = Spaces(Encoding(parse_description(SOURCES[2], "office.al")), most_states)
    for _, state, goal in _questions(SOURCES[2], 25):
        bounds = spaces.bounds(state, goal)
        assert bounds is not None
        least = bounds.least(LIMIT, _nothing)
        if least is not None:
            bounds.steps(least + 3, _nothing)
            assert bounds.least(LIMIT, _nothing) == least


def test_a_limit_is_no_proof_and_can_be_raised() -> None:
    spaces = Spaces(Encoding(parse_description(SOURCES[0], "office.al")), EVERYTHING)
    state = frozenset(["loc(rob1,library)", "loc(book1,office1)", "loc(book2,office1)"])
    bounds = spaces.bounds(state, ["loc(book1,library)"])
    assert bounds is not None
    assert bounds.least(6, _nothing) is None
    assert bounds.least(7, _nothing) == 7
