"""The least number of actions that achieves a goal, with complete knowledge and nothing unforeseen.

Breadth-first search over the compiled world: it shares no line with the robots' planners.
"""

from __future__ import annotations

from collections.abc import Collection, Iterable, Iterator
from functools import lru_cache

from asp.description import Description
from asp.grounding import ground_description
from asp.kept.independence import Independence
from asp.literals import atom
from asp.restriction import narrowed, restrict
from asp.signature import Signature
from asp.syntax import Source
from testbed.environment.world import World


def shortest_plan(world: World, initial: int, goal: Iterable[str]) -> tuple[str, ...] | None:
    """A plan with the fewest robot actions from `initial` to a state of `goal`; None if none."""
    wanted = tuple(goal)
    came_from: dict[int, tuple[int, str] | None] = {initial: None}
    frontier = [initial]
    while frontier:
        found = next((state for state in frontier if world.satisfies(state, wanted)), None)
        if found is not None:
            return tuple(_path(came_from, found))
        frontier = [reached for state in frontier for reached in _expand(world, state, came_from)]
    return None


def minimal_actions(world: World, initial: int, goal: Iterable[str]) -> int | None:
    """Length of a shortest plan, or None where the goal cannot be reached."""
    plan = shortest_plan(world, initial, goal)
    return None if plan is None else len(plan)


def _expand(
    world: World, state: int, came_from: dict[int, tuple[int, str] | None]
) -> Iterator[int]:
    for action in world.agent_actions:
        if not world.executable(state, (action,)):
            continue
        for reached in world.successors(state, (action,)):
            if reached not in came_from:
                came_from[reached] = (state, action)
                yield reached


def _path(came_from: dict[int, tuple[int, str] | None], last: int) -> list[str]:
    actions: list[str] = []
    step = came_from[last]
    while step is not None:
        actions.append(step[1])
        step = came_from[step[0]]
    return actions[::-1]


class Oracle:
    """The oracle of a domain with many constants: it leaves out those that no plan needs."""

    def __init__(self, description: Description, source: Source, signature: Signature) -> None:
        self._name, self._source, self._signature = description.name, source, signature
        self._independence = Independence(description, source, signature)
        self._world = lru_cache(maxsize=64)(self._without)

    def minimal_actions(self, state: Collection[str], goal: Iterable[str]) -> int | None:
        """As `minimal_actions`, from the state with these true atoms."""
        wanted = tuple(goal)
        dropped = self._independence.droppable(state, wanted)
        world = self._world(dropped)
        known = frozenset(world.fluents)
        left = [literal for literal in wanted if atom(literal) in known]
        return minimal_actions(world, world.state(a for a in state if a in known), left)

    def _without(self, dropped: frozenset[str]) -> World:
        source, signature = restrict(self._source, dropped), narrowed(self._signature, dropped)
        return World(ground_description(source, signature, self._name))
