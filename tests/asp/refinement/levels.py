"""Refinements of levels, and coarse transitions of them, for tests."""

from collections.abc import Iterator
from functools import cache

from asp.domains import LEVELS, LevelSize, level_text
from asp.refinement import Refinement, Transition, load
from testbed.world import World, world_of


@cache
def level(name: str) -> Refinement:
    """The refinement of a published level."""
    return of_size(LEVELS[name], name)


@cache
def of_size(size: LevelSize, name: str = "level") -> Refinement:
    coarse, fine = level_text(size.rooms, size.rows, size.columns, size.objects)
    return load(coarse, f"{name}.al", fine, f"{name}.fine")


@cache
def coarse_world(refinement: Refinement) -> World:
    return world_of(refinement.description)


def transitions(refinement: Refinement) -> Iterator[Transition]:
    """Every coarse transition with one action of the robot or of others."""
    world = coarse_world(refinement)
    for state in world.initial_states():
        yield from transitions_from(refinement, state)


def transitions_from(refinement: Refinement, state: int) -> Iterator[Transition]:
    world = coarse_world(refinement)
    before = frozenset(world.true_atoms(state))
    for action in world.agent_actions + world.exogenous_actions:
        for after in world.successors(state, [action]):
            yield Transition(before, action, frozenset(world.true_atoms(after)))
