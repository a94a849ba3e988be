"""The judge's heuristic: the same least numbers as without it, from fewer states."""

import json
from collections.abc import Iterable, Mapping
from pathlib import Path
from random import Random

import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from asp.language import SourceError, parse_description
from testbed.config import load_config
from testbed.experiment.runner import play_missing
from testbed.search import plans
from testbed.search.heuristic import Potentials, blind
from testbed.world import World, load_world, world_of
from tests.experiment.gardens import GARDEN
from tests.literals import parsed
from tests.oracle import minimal_units
from tests.world.test_world_random import HEADER, laws

Least = Mapping[int, int]

DEPOT = """
sorts
  bay     = {b0, b1, b2, b3, b4, b5, b6, b7}.
  truck   = {hauler}.
  crate   = {c1, c2, c3, c4, c5, c6}.
  vehicle = truck + crate.
statics
  beside(bay, bay).
fluents
  inertial stands(vehicle, bay).
  inertial loaded(truck, crate).
actions
  agent     drive(truck, bay).
  agent     load(truck, crate).
  agent     drop(truck, crate).
  exogenous vanish(truck).
laws
  drive(T, B) causes stands(T, B).
  load(T, C)  causes loaded(T, C).
  drop(T, C)  causes -loaded(T, C).
  vanish(T)   causes -loaded(T, C).
  -stands(V, A) if stands(V, B), A != B.
  stands(C, B) if stands(T, B), loaded(T, C).
  -loaded(T, C1) if loaded(T, C2), C1 != C2.
  impossible drive(T, B) if stands(T, A), -beside(A, B).
  impossible load(T, C) if loaded(T, D).
  impossible load(T, C) if stands(T, A), stands(C, B), A != B.
  impossible drop(T, C) if -loaded(T, C).
  beside(A, B) if beside(B, A).
facts
  beside(b0, b1).  beside(b1, b2).  beside(b2, b3).  beside(b3, b4).
  beside(b4, b5).  beside(b5, b6).  beside(b6, b7).
initially
  stands(V, B) for some B.
sees
  T sees stands(V, B) if truck(T).
  T sees loaded(T, C).
costs
  drive(T, B) costs 7.
  load(T, C)  costs 3.
  drop(T, C)  costs 2.
scenarios
  quiet: nothing.
"""
"""Bays in a row: whatever is brought to the first is brought alone, there and back again."""

CARTS = """
sorts
  porter = {joe}.
  cart   = {barrow}.
  pot    = {jar, jug}.
  place  = {shed, lawn, gate}.
  thing  = porter + cart + pot.
fluents
  inertial at(thing, place).
  inertial on(pot, cart).
  inertial icy.
  defined  laden(cart).
actions
  agent haul(porter, cart, place).
  agent heap(porter, pot, cart).
  agent tip(porter, cart).
  agent salt(porter).
laws
  haul(J, C, P) causes at(J, P) if -icy.
  haul(J, C, P) causes at(C, P).
  heap(J, X, C) causes on(X, C).
  tip(J, C)     causes -on(X, C) if laden(C).
  salt(J)       causes -icy.
  -at(T, P) if at(T, Q), P != Q.
  at(X, P) if on(X, C), at(C, P).
  laden(C) if on(X, C).
  impossible haul(J, C, P) if at(J, Q), at(C, R), Q != R.
  impossible heap(J, X, C) if at(X, P), at(C, Q), P != Q.
  impossible salt(J) if at(J, gate).
initially
  at(T, P) for some P.
sees
  J sees icy if porter(J).
costs
  haul(J, C, P) costs 5.
  heap(J, X, C) costs 1.
  tip(J, C)     costs 0.
  salt(J)       costs 9.
"""
"""One action moves any number of things, and its effects depend on what is so."""

TOWERS = """
sorts
  brick = {red, blue, green}.
  spot  = brick + {floor}.
fluents
  inertial rests(brick, spot).
actions
  agent stack(brick, spot).
laws
  stack(B, S) causes rests(B, S).
  -rests(B, S) if rests(B, Z), S != Z.
  -rests(B, S) if rests(Z, S), B != Z, brick(S).
  impossible stack(B, S) if rests(Z, B).
  impossible stack(B, S) if rests(Z, S), brick(S).
  impossible stack(B, B).
costs
  stack(B, S) costs 2.
"""
"""It does not say that a brick rests anywhere."""

SAILS = """
sorts
  mast = {fore, aft}.
fluents
  inertial set(mast).
  inertial moored.
actions
  agent strike(mast).
  agent moor.
  agent hire.
laws
  strike(M) causes -set(M).
  moor causes moored if -set(fore), -set(aft).
  hire causes moored.
initially
  set(M) for some M.
costs
  strike(M) costs 3.
  moor costs 1.
  hire costs 50.
"""
"""What every initial state has is given up on the way."""


def distances(world: World, goal: Iterable[str], costs: Mapping[str, int]) -> Least:
    """The least cost from every state from which the goal can be achieved, by relaxation."""
    goal, states = tuple(goal), tuple(world.states())
    steps = [
        (state, costs[action], after)
        for state in states
        for action in world.agent_actions
        for after in world.successors(state, (action,))
    ]
    least = {state: 0 for state in states if world.satisfies(state, goal)}
    changed = True
    while changed:
        changed = False
        for state, own, after in steps:
            if after in least and own + least[after] < least.get(state, own + least[after] + 1):
                least[state], changed = own + least[after], True
    return least


def check(world: World, goal: tuple[str, ...], costs: Mapping[str, int], starts: int) -> None:
    """The heuristic is consistent from the starts on, and changes no least number."""
    goal = parsed(goal)
    least, states = distances(world, goal, costs), tuple(world.states())
    potentials = Potentials(world.description)
    for start in Random(1).sample(states, min(starts, len(states))):
        heuristic, reached, left = potentials.heuristic(start, goal, costs), {start}, [start]
        while left:
            state = left.pop()
            assert heuristic(state) <= least.get(state, heuristic(state))
            for action, after in world.moves(state):
                assert heuristic(state) <= costs[action] + heuristic(after)
                left += {after} - reached
                reached.add(after)
        assert minimal_units(world, start, goal, costs) == least.get(start)


@pytest.fixture
def at_once(monkeypatch: pytest.MonkeyPatch) -> None:
    """The heuristic is found after the first state."""
    monkeypatch.setattr(plans, "UNINFORMED", 1)


def measures(world: World) -> tuple[Mapping[str, int], Mapping[str, int]]:
    """What actions count, and what they cost."""
    return dict.fromkeys(world.agent_actions, 1), world.description.costs


@pytest.mark.usefixtures("at_once")
@pytest.mark.parametrize(
    "goal",
    [
        parsed(["loc(book1,library)", "loc(book2,library)", "-in_hand(rob1,book2)"]),
        parsed(["loc(book1,office1)", "in_hand(rob1,book2)", "-locked(library)"]),
    ],
)
def test_from_every_state_of_the_office_the_least_is_the_same(goal: tuple[str, ...]) -> None:
    world, goal = load_world("office"), parsed(goal)
    for costs in measures(world):
        least = distances(world, goal, costs)
        for state in world.states():
            assert minimal_units(world, state, goal, costs) == least.get(state)


@pytest.mark.usefixtures("at_once")
@pytest.mark.parametrize(
    ("text", "goal"),
    [
        (GARDEN.replace("OTHER", "rake"), parsed(["stands(rake,north)", "stands(spade,south)"])),
        (CARTS, parsed(["at(jar,gate)", "at(jug,lawn)", "-laden(barrow)"])),
        (CARTS, ("at(joe,shed)", "at(barrow,lawn)", "icy")),
        (TOWERS, parsed(["rests(red,blue)", "rests(blue,green)"])),
        (TOWERS, parsed(["rests(red,blue)", "-rests(green,floor)"])),
        (SAILS, ("moored",)),
    ],
)
def test_where_things_go_along_the_heuristic_is_consistent(
    text: str, goal: tuple[str, ...]
) -> None:
    world = world_of(parse_description(text))
    for costs in measures(world):
        check(world, goal, costs, 40)


@settings(max_examples=60)
@given(st.lists(laws(), min_size=1, max_size=9), st.booleans(), st.data())
def test_in_a_random_world_the_heuristic_is_consistent(
    drawn: list[str], initially: bool, data: st.DataObject
) -> None:
    text = HEADER + "\n".join(f"  {law}" for law in drawn) + "\n"
    try:
        world = world_of(parse_description(text + "initially\n  h(T) for some T.\n" * initially))
    except SourceError as error:  # a fluent defined through its own negation
        assume("defined through its own negation" not in str(error))
        raise
    literals = [sign + fluent for fluent in world.fluents for sign in ("", "-")]
    goal = tuple(data.draw(st.lists(st.sampled_from(literals), min_size=1, max_size=3)))
    costs = {action: data.draw(st.integers(0, 9)) for action in world.agent_actions}
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(plans, "UNINFORMED", 1)
        check(world, goal, costs, 16)


def test_what_is_too_much_to_enumerate_is_searched_without(monkeypatch: pytest.MonkeyPatch) -> None:
    world = world_of(parse_description(CARTS))
    start, goal, (costs, _) = next(world.states()), parsed(["at(jar,gate)"]), measures(world)
    assert Potentials(world.description).heuristic(start, goal, costs) is not blind
    monkeypatch.setattr("testbed.search.heuristic.MOST_CHANGES", 3)
    assert Potentials(world.description).heuristic(start, goal, costs) is blind


def test_six_crates_are_judged_within_the_default_budget(tmp_path: Path) -> None:
    """Each is fetched and brought: twice its way, and all but the last one are dropped."""
    (tmp_path / "depot.al").write_text(DEPOT)
    goal = ", ".join(f'"stands(c{number},b0)"' for number in range(1, 7))
    places = ", ".join(f'"stands(c{number},b{number + 1})"' for number in range(1, 7))
    (tmp_path / "depot.yaml").write_text(
        f"name: depot\ndomain: depot.al\ngoal: [{goal}]\nscenarios: [quiet]\n"
        f'initial: ["stands(hauler,b0)", {places}]\nrobots: [traditional]\nlimits: {{steps: 1}}\n'
    )
    config = load_config(str(tmp_path / "depot.yaml"), ["link=inprocess", "limits.expansions=1"])
    play_missing(config, tmp_path / "run", 1, lambda _: None)
    (trial,) = map(json.loads, (tmp_path / "run" / "trials.jsonl").read_text().splitlines())
    away = sum(range(2, 8))
    assert trial["minimal_reason"] is None
    assert trial["minimal_actions"] == 2 * away + 6 + 5
    assert trial["minimal_units"] == 7 * 2 * away + 3 * 6 + 2 * 5
