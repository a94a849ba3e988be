"""The judge of trials: the fewest actions, and units, that achieve a goal, by complete knowledge.

It searches the compiled world within a budget of states, and shares no line with the robots'
planners: by uniform cost at first, then A* with a heuristic that is consistent in every domain.
"""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterable, Mapping
from functools import lru_cache
from heapq import heapify, heappop, heappush
from itertools import count

from asp.language import (
    Description,
    Signature,
    Source,
    atom,
    ground_description,
    narrowed,
    restrict,
    without_exogenous,
)
from asp.reasoning.relevance import Relevance
from testbed.experiment.heuristic.potentials import Heuristic, Potentials, blind
from testbed.experiment.record import Minimal, MinimalReason
from testbed.world import World, world_of

MOST_ANSWERS = 4_096
"""How many answers are remembered: trials from the same state ask the same."""
Goal = tuple[str, ...]
Problem = tuple[World, int, Goal]
"""A world, the state to begin in, and the goal."""
UNINFORMED = 200
"""States expanded by uniform cost: most searches end before a heuristic would be found."""


class Judge:
    """Answers questions about states of one world, each once."""

    def __init__(self, problem: Callable[[int, Goal], Problem], costs: Mapping[str, int]) -> None:
        """`problem` gives what is searched for a state and a goal; `costs` are execution units."""
        self._problem, self._costs = problem, costs
        self._fewest = lru_cache(MOST_ANSWERS)(self._search)
        self.minimal = lru_cache(MOST_ANSWERS)(self._minimal)

    def in_reach(self, state: int, goal: Goal, most_states: int) -> bool | None:
        """Whether some plan achieves the goal from the state; None where the budget struck."""
        _, reason = self._fewest(state, goal, most_states)
        return None if reason == "budget" else reason is None

    def _search(
        self, state: int, goal: Goal, most_states: int
    ) -> tuple[int | None, MinimalReason | None]:
        """The fewest actions; where they are not known, why."""
        try:
            actions = minimal_actions(*self._problem(state, goal), most_states)
        except BudgetError:
            return None, "budget"
        return actions, "no plan" if actions is None else None

    def _minimal(self, state: int, goal: Goal, most_states: int) -> Minimal:
        """The least that achieves the goal from the state.

        Where the budget suffices for the actions and not for the units, only these are unknown.
        """
        actions, reason = self._fewest(state, goal, most_states)
        if actions is None:
            return Minimal(None, None, reason)
        try:
            units = minimal_units(*self._problem(state, goal), self._costs, most_states)
        except BudgetError:
            units = None
        return Minimal(actions, units, None)


class BudgetError(RuntimeError):
    """A search would have to look at more states than its budget allows."""


def shortest_plan(
    world: World, initial: int, goal: Iterable[str], most_states: int | None = None
) -> tuple[str, ...] | None:
    """A plan with the fewest robot actions from `initial` to a state of `goal`; None if none.

    Raises BudgetError where more than `most_states` states would have to be expanded.
    """
    alike: dict[str, int] = dict.fromkeys(world.agent_actions, 1)
    return _cheapest(world, initial, goal, alike, most_states)


def minimal_actions(
    world: World, initial: int, goal: Iterable[str], most_states: int | None = None
) -> int | None:
    """Length of a shortest plan, or None where the goal cannot be reached. Raises BudgetError."""
    plan = shortest_plan(world, initial, goal, most_states)
    return None if plan is None else len(plan)


def minimal_units(
    world: World,
    initial: int,
    goal: Iterable[str],
    costs: Mapping[str, int],
    most_states: int | None = None,
) -> int | None:
    """Execution units of a cheapest plan, or None where the goal cannot be reached.

    What has no cost costs 0. Raises BudgetError.
    """

    plan = _cheapest(world, initial, goal, costs, most_states)
    return None if plan is None else sum(costs.get(action, 0) for action in plan)


def _cheapest(
    world: World,
    initial: int,
    goal: Iterable[str],
    costs: Mapping[str, int],
    most_states: int | None,
) -> tuple[str, ...] | None:
    """Of the cheapest plans the one that is found first."""
    wanted, number = tuple(goal), count()
    heuristic: Heuristic = blind
    came_from: dict[int, tuple[int, str] | None] = {initial: None}
    least, expanded = {initial: 0}, 0
    # By the least cost of a plan through a state, then by the least of what is left of it.
    frontier = [(0, 0, next(number), initial)]
    while frontier:
        total, left, _, state = heappop(frontier)
        if total - left > least[state]:
            continue
        if world.satisfies(state, wanted):
            return tuple(_path(came_from, state))
        if expanded == most_states:
            raise BudgetError(f"more than {most_states} states")
        expanded += 1
        for action, reached in world.moves(state):
            spent = least[state] + costs.get(action, 0)
            if reached not in least or spent < least[reached]:
                least[reached], came_from[reached] = spent, (state, action)
                left = heuristic(reached)
                heappush(frontier, (spent + left, left, next(number), reached))
        if expanded == UNINFORMED:
            heuristic = _potentials(world).heuristic(initial, wanted, costs)
            current = [(n, s) for total, _, n, s in frontier if total == least[s]]
            frontier = [(least[s] + (left := heuristic(s)), left, n, s) for n, s in current]
            heapify(frontier)
    return None


@lru_cache(maxsize=64)
def _potentials(world: World) -> Potentials:
    return Potentials(world.description)


def _path(came_from: Mapping[int, tuple[int, str] | None], last: int) -> list[str]:
    actions: list[str] = []
    step = came_from[last]
    while step is not None:
        actions.append(step[1])
        step = came_from[step[0]]
    return actions[::-1]


class Narrowing:
    """Leaves out the constants of a large domain that no plan needs."""

    def __init__(self, description: Description, source: Source, signature: Signature) -> None:
        self._name, self._source, self._signature = description.name, source, signature
        self._relevance = Relevance(without_exogenous(source, signature), signature)
        self._world = lru_cache(maxsize=64)(self._without)

    def problem(self, state: Collection[str], goal: Iterable[str]) -> Problem:
        """The narrowed world, and in it the state with these true atoms, and the goal."""
        wanted = tuple(goal)
        world = self._world(self._relevance.spare(state, wanted))
        known = frozenset(world.fluents)
        left = tuple(literal for literal in wanted if atom(literal) in known)
        return world, world.state(a for a in state if a in known), left

    def _without(self, dropped: frozenset[str]) -> World:
        source, signature = restrict(self._source, dropped), narrowed(self._signature, dropped)
        return world_of(ground_description(source, signature, self._name))
