"""Problems without what no plan needs, and those of a refinement at its coarse resolution."""

from collections.abc import Collection
from functools import lru_cache

from asp.language import (
    Fluent,
    Signature,
    ground_description,
    narrowed,
    restrict,
    syntax,
    without_exogenous,
)
from asp.reasoning import Relevance
from asp.refinement import Refinement
from testbed.search.plans import Goal, Problem
from testbed.world import World, world_of


class Narrowing:
    """Leaves out the constants of a large domain that no plan needs."""

    def __init__(self, source: syntax.Source, signature: Signature, name: str) -> None:
        self._source, self._signature, self._name = source, signature, name
        self._relevance = Relevance(without_exogenous(source, signature), signature)
        self._world = lru_cache(maxsize=64)(self._without)

    def problem(self, state: Collection[Fluent], goal: Goal) -> Problem:
        """The narrowed world, and in it the state with these true atoms, and the goal."""
        world = self._world(self._relevance.spare(state, goal))
        known = frozenset(world.fluents)
        left = tuple(literal for literal in goal if literal.atom in known)
        return world, world.state(a for a in state if a in known), left

    def _without(self, dropped: frozenset[str]) -> World:
        source, signature = restrict(self._source, dropped), narrowed(self._signature, dropped)
        return world_of(ground_description(source, signature, self._name))


def coarse_problem(refinement: Refinement, state: int, goal: Goal) -> Problem:
    """The problem of a fine state: the coarse one of it, narrowed.

    A goal with fine literals is one of the fine world, as it is.
    """
    narrowing, coarse = _coarse(refinement)
    fine = world_of(refinement)
    if not coarse.issuperset(literal.atom for literal in goal):
        return fine, state, goal
    return narrowing.problem(coarse.intersection(fine.true_atoms(state)), goal)


@lru_cache(maxsize=16)
def _coarse(refinement: Refinement) -> tuple[Narrowing, frozenset[Fluent]]:
    signature, name = refinement.coarse_signature, refinement.description.name
    known = frozenset(refinement.description.fluents)
    return Narrowing(refinement.coarse, signature, name), known
