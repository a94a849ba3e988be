"""The fewest actions, and the fewest units, that achieve a goal: complete knowledge, no surprises.

Breadth-first search, and Dijkstra's, over the compiled world: neither shares a line with the
robots' planners.
"""

from __future__ import annotations

from collections.abc import Collection, Iterable, Iterator, Mapping
from functools import lru_cache
from heapq import heappop, heappush

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


def minimal_units(
    world: World, initial: int, goal: Iterable[str], costs: Mapping[str, int]
) -> int | None:
    """Execution units of a cheapest plan, or None where the goal cannot be reached.

    What has no cost costs 0.
    """
    wanted = tuple(goal)
    frontier, done = [(0, initial)], set[int]()
    while frontier:
        spent, state = heappop(frontier)
        if world.satisfies(state, wanted):
            return spent
        if state in done:
            continue
        done.add(state)
        for action in world.agent_actions:
            if world.executable(state, (action,)):
                for reached in world.successors(state, (action,)):
                    heappush(frontier, (spent + costs.get(action, 0), reached))
    return None


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
        return minimal_actions(*self._narrowed(state, goal))

    def minimal_units(
        self, state: Collection[str], goal: Iterable[str], costs: Mapping[str, int]
    ) -> int | None:
        """As `minimal_units`, from the state with these true atoms."""
        return minimal_units(*self._narrowed(state, goal), costs)

    def _narrowed(
        self, state: Collection[str], goal: Iterable[str]
    ) -> tuple[World, int, list[str]]:
        wanted = tuple(goal)
        dropped = self._independence.droppable(state, wanted)
        world = self._world(dropped)
        known = frozenset(world.fluents)
        left = [literal for literal in wanted if atom(literal) in known]
        return world, world.state(a for a in state if a in known), left

    def _without(self, dropped: frozenset[str]) -> World:
        source, signature = restrict(self._source, dropped), narrowed(self._signature, dropped)
        return World(ground_description(source, signature, self._name))
