"""Cheapest plans of the robot, found by search of a world within a budget of states.

The search shares no line with the robots' planners: it is by uniform cost at first, then A* with a
heuristic that is consistent in every domain.
"""

from collections.abc import Callable, Mapping
from functools import lru_cache
from heapq import heapify, heappop, heappush
from itertools import count

from asp.language import Action, Literal
from testbed.search.heuristic import Heuristic, Potentials, blind
from testbed.world import World

Goal = tuple[Literal, ...]
Problem = tuple[World, int, Goal]
"""A world, the state to begin in, and the goal."""
Pose = Callable[[int, Goal], Problem]
"""Poses the problem of a state and a goal of a game."""
UNINFORMED = 200
"""States expanded by uniform cost: most searches end before a heuristic would be found."""


def as_it_is(world: World, state: int, goal: Goal) -> Problem:
    """The problem in a world itself."""
    return world, state, goal


class BudgetError(RuntimeError):
    """A search would have to look at more states than its budget allows."""


def cheapest_plan(
    problem: Problem, costs: Mapping[str, int] | None = None, most_states: int | None = None
) -> tuple[Action, ...] | None:
    """Of the cheapest plans of robot actions to a state of the goal the first; None if none.

    What has no cost costs 0; without costs the plan is one with the fewest actions. Raises
    BudgetError where more than `most_states` states would have to be expanded.
    """
    (world, initial, goal), number = problem, count()
    alike: dict[str, int] = dict.fromkeys(world.agent_actions, 1)
    price = alike if costs is None else costs
    heuristic: Heuristic = blind
    came_from: dict[int, tuple[int, Action] | None] = {initial: None}
    least, expanded = {initial: 0}, 0
    # By the least cost of a plan through a state, then by the least of what is left of it.
    frontier = [(0, 0, next(number), initial)]
    while frontier:
        total, left, _, state = heappop(frontier)
        if total - left > least[state]:
            continue
        if world.satisfies(state, goal):
            return _path(came_from, state)
        if expanded == most_states:
            raise BudgetError(f"more than {most_states} states")
        expanded += 1
        for action, reached in world.moves(state):
            spent = least[state] + price.get(action, 0)
            if reached not in least or spent < least[reached]:
                least[reached], came_from[reached] = spent, (state, action)
                left = heuristic(reached)
                heappush(frontier, (spent + left, left, next(number), reached))
        if expanded == UNINFORMED:
            heuristic = potentials_of(world).heuristic(initial, goal, price)
            current = [(n, s) for total, _, n, s in frontier if total == least[s]]
            frontier = [(least[s] + (left := heuristic(s)), left, n, s) for n, s in current]
            heapify(frontier)
    return None


def _path(came_from: Mapping[int, tuple[int, Action] | None], state: int) -> tuple[Action, ...]:
    actions: list[Action] = []
    while (step := came_from[state]) is not None:
        state, action = step
        actions.append(action)
    return tuple(reversed(actions))


@lru_cache(maxsize=64)
def potentials_of(world: World) -> Potentials:
    """The heuristics of a world; making them takes long in a large one."""
    return Potentials(world.description)
