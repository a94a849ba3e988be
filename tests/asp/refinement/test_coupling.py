"""For every coarse transition there is a path between refinements of its states (P 3.3)."""

import random
from collections.abc import Iterable
from functools import cache
from itertools import product
from pathlib import Path

import pytest

from asp.language import Literal
from asp.refinement import Refinement, Transition, load_refinement, relevant, zoom
from testbed.world import world_of
from tests.asp.refinement.levels import coarse_world, level, transitions, transitions_from
from tests.asp.refinement.paths import Paths, drawn_refinement, literals_of, some_refinement
from tests.literals import parsed

TABLETOP = str(Path(__file__).with_name("tabletop.fine"))
FARTHEST = {"L1": 2, "L2": 2, "L3": 3, "L4": 5, "L5": 5, "L6": 6, "L7": 7, "L8": 7}
"""The most concrete actions that an abstract one takes: across its room and into the next."""


@cache
def whole(refinement: Refinement, kind: str, steps: int) -> Paths:
    return Paths(refinement.weak, kind, steps)


@cache
def zoomed(refinement: Refinement, constants: frozenset[str], kind: str, steps: int) -> Paths:
    return Paths(zoom(refinement.weak, refinement, constants), kind, steps)


def kind_of(refinement: Refinement, transition: Transition) -> str:
    acts = transition.action in refinement.description.agent_actions
    return "agent" if acts else "exogenous"


@pytest.mark.parametrize("name", ["L1", "L2", "L3"])
def test_every_transition_of_a_small_level_has_a_path_from_a_drawn_refinement(name: str) -> None:
    refinement, rng, found = level(name), random.Random(name), 0
    for transition in transitions(refinement):
        kind = kind_of(refinement, transition)
        paths = whole(refinement, kind, FARTHEST[name] if kind == "agent" else 1)
        start = drawn_refinement(refinement, transition.before, rng)
        assert paths.find(start, literals_of(refinement, transition.after)), transition
        found += 1
    assert found == {"L1": 14, "L2": 240, "L3": 4512}[name]


@pytest.mark.parametrize("name", ["L1", "L2", "L3"])
def test_every_transition_of_the_robot_has_a_path_in_the_zoomed_description(name: str) -> None:
    refinement, rng = level(name), random.Random(name)
    for transition in transitions(refinement):
        if kind_of(refinement, transition) == "agent":
            check_zoomed(refinement, transition, drawn_goal(refinement, rng), rng, FARTHEST[name])


def check_zoomed(
    refinement: Refinement, transition: Transition, goal: list[str], rng: random.Random, steps: int
) -> tuple[list[str], list[str]]:
    """The start drawn for a transition and the path that the zoomed description has from it."""
    constants = relevant(refinement, transition, goal)
    paths = zoomed(refinement, constants, "agent", steps)
    start = drawn_refinement(refinement, transition.before, rng)
    path = paths.find(start, literals_of(refinement, transition.after))
    assert path is not None, (transition, goal)
    return start, path


def drawn_goal(refinement: Refinement, rng: random.Random) -> list[str]:
    sorts = refinement.coarse_signature.sorts
    return parsed([f"loc({rng.choice(sorts['object'])},{rng.choice(sorts['room'])})"])


@pytest.mark.parametrize("name", ["L4", "L5", "L6", "L7", "L8"])
def test_paths_of_zoomed_descriptions_are_paths_of_the_whole_one(name: str) -> None:
    """A sample; the whole is played law by law, since it cannot be instantiated."""
    refinement, rng = level(name), random.Random(name)
    world = world_of(refinement)
    for transition in sampled(refinement, rng, 6):
        goal = drawn_goal(refinement, rng)
        start, path = check_zoomed(refinement, transition, goal, rng, FARTHEST[name])
        state = world.state(start)
        for action in path:
            state = world.successor(state, [action])
        assert world.satisfies(state, literals_of(refinement, transition.after))


def sampled(refinement: Refinement, rng: random.Random, number: int) -> Iterable[Transition]:
    """Drawn transitions of the robot from drawn states; in every other state it holds something."""
    sorts = refinement.coarse_signature.sorts
    world = coarse_world(refinement)
    for count in range(number):
        rooms = {thing: rng.choice(sorts["room"]) for thing in sorts["thing"]}
        held = rng.choice(sorts["object"])
        atoms = parsed([f"in_hand(rob1,{held})"]) if count % 2 else []
        rooms |= {held: rooms["rob1"]} if atoms or count % 4 == 0 else {}
        state = world.state([*atoms, *parsed(f"loc({t},{r})" for t, r in rooms.items())])
        robots = [
            transition
            for transition in transitions_from(refinement, state)
            if kind_of(refinement, transition) == "agent"
        ]
        yield rng.choice(robots)


@pytest.mark.parametrize("name", ["office.fine", TABLETOP], ids=["office", "tabletop"])
def test_every_transition_has_a_path_from_some_refinement(name: str) -> None:
    """Of a domain with attributes that are not magnified, and of one that is no office."""
    refinement = load_refinement(name)
    found = list(transitions(refinement))
    for transition in found:
        kind = kind_of(refinement, transition)
        paths = whole(refinement, kind, 3 if kind == "agent" else 1)
        before, after = (literals_of(refinement, s) for s in (transition.before, transition.after))
        assert paths.find(before, after), transition
    assert {t.action.partition("(")[0] for t in found} == {
        symbol
        for symbol, declaration in refinement.coarse_signature.symbols.items()
        if declaration.kind in ("agent", "exogenous")
    }


@pytest.mark.parametrize("name", ["office.fine", TABLETOP], ids=["office", "tabletop"])
def test_a_fine_action_does_at_the_coarse_resolution_nothing_or_what_the_coarse_one_does(
    name: str,
) -> None:
    refinement, rng = load_refinement(name), random.Random(1)
    world = coarse_world(refinement)
    fine = world_of(refinement)
    fluents = frozenset(refinement.description.fluents)
    done: set[str] = set()
    for state in rng.sample(world.initial_states(), 30):
        before = frozenset(world.true_atoms(state))
        start = fine.state(some_refinement(refinement, literals_of(refinement, before), rng))
        for action in fine_actions(refinement):
            (coarse,) = refinement.coarse_of(action)
            known = {frozenset(world.true_atoms(s)) for s in world.successors(state, [coarse])}
            for after in fine.successors(start, [action]):
                seen = fluents.intersection(fine.true_atoms(after))
                assert seen == before or seen in known, (before, action)
                done |= {action.partition("(")[0]} if seen != before else set()
    assert done == {
        refinement.counterparts.get(action.partition("(")[0], action.partition("(")[0])
        for action in world.agent_actions + world.exogenous_actions
    }


def fine_actions(refinement: Refinement) -> list[str]:
    signature = refinement.weak_signature
    return [
        Literal.of(symbol, args)
        for symbol, declaration in signature.symbols.items()
        if declaration.kind in ("agent", "exogenous")
        for args in product(*(signature.sorts[sort.name] for sort in declaration.sorts))
    ]
