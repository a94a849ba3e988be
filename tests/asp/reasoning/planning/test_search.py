"""Searches find the length of shortest plans, and the first of them."""

import random
from collections.abc import Iterator, Sequence

import pytest

from asp.language import Fluent, Literal, parse_description
from asp.reasoning.planning import Encoding
from asp.reasoning.planning.large.search import Search, StateSpace
from asp.solving.budget import Budget
from benchmarks.offices import office
from testbed.world import World, world_of
from tests.literals import parsed

SOURCES = (office(), office(books=1, rooms=5, shape="grid"), office(books=2, rooms=4, secure=2))


class StopError(Exception):
    """Raised where expansions are spent."""


class _Layers:
    """How far every state is from one state, by the compiled world."""

    def __init__(self, world: World, state: int) -> None:
        self.world = world
        self.distance = {state: 0}
        waiting = [state]
        for now in waiting:  # grows while it is read
            for action in world.agent_actions:
                for after in world.successors(now, (action,)):
                    if after not in self.distance:
                        self.distance[after] = self.distance[now] + 1
                        waiting.append(after)

    def length(self, goal: tuple[Literal, ...]) -> int | None:
        satisfying = (d for s, d in self.distance.items() if self.world.satisfies(s, goal))
        return min(satisfying, default=None)


def _questions(
    source: str, number: int
) -> Iterator[tuple[_Layers, frozenset[Fluent], tuple[Literal, ...]]]:
    description = parse_description(source, "office.al")
    world, draw = world_of(description), random.Random(3)
    states = list(world.initial_states())
    for _ in range(number):
        state = draw.choice(states)
        fluents = draw.sample(description.fluents, draw.choice([1, 2]))
        goal = tuple(draw.choice([f, f, f.complement]) for f in fluents)
        yield _Layers(world, state), frozenset(world.true_atoms(state)), goal


def _search(source: str, state: frozenset[Fluent], goal: Sequence[Literal]) -> Search:
    search = StateSpace(Encoding(parse_description(source, "office.al"))).search(state, goal)
    assert search is not None
    return search


@pytest.mark.parametrize("source", SOURCES)
def test_the_length_is_that_of_a_shortest_plan(source: str) -> None:
    for layers, state, goal in _questions(source, 40):
        search = _search(source, state, goal)
        length = search.distance(None)
        assert length == layers.length(goal)
        if length is not None:
            assert len(search.first_plan()) == length


def test_a_search_that_was_stopped_goes_on_where_it_was(monkeypatch: pytest.MonkeyPatch) -> None:
    state = frozenset(
        parsed(["loc(rob1,library)", "loc(book1,office1)", "loc(book2,office1)", "locked(library)"])
    )
    goal = parsed(["loc(book1,library)", "loc(book2,library)", "-in_hand(rob1,book2)"])
    whole, stopped = (_search(SOURCES[0], state, goal) for _ in range(2))
    layers = 0

    def once(_budget: Budget, _expansions: int) -> None:
        nonlocal layers
        layers += 1
        if layers % 2:
            raise StopError

    found = None
    with monkeypatch.context() as patched:
        patched.setattr(Budget, "take_expansions", once)
        while found is None:
            try:
                found = stopped.distance(60)
            except StopError:
                assert layers < 60
    assert found == whole.distance(60)
    assert layers == 2 * found
    assert stopped.first_plan() == whole.first_plan()


def test_a_limit_is_no_proof_and_can_be_raised() -> None:
    state = frozenset(parsed(["loc(rob1,library)", "loc(book1,office1)", "loc(book2,office1)"]))
    search = _search(SOURCES[0], state, parsed(["loc(book1,library)"]))
    assert search.distance(6) is None
    assert search.distance(7) == 7
