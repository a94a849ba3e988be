"""The judge of trials: the fewest actions, and units, that achieve a goal, by complete knowledge.

It searches the compiled world within a budget of states, and shares no line with the robots'
planners: by uniform cost at first, then A* with a heuristic that is consistent in every domain.
"""

from collections.abc import Callable, Collection, Mapping
from functools import lru_cache
from heapq import heapify, heappop, heappush
from itertools import count

from asp.language import (
    Action,
    Fluent,
    Literal,
    Signature,
    ground_description,
    narrowed,
    restrict,
    syntax,
    without_exogenous,
)
from asp.reasoning import Relevance
from testbed.experiment.heuristic import Heuristic, Potentials, blind
from testbed.experiment.record import Minimal
from testbed.world import World, world_of

MOST_ANSWERS = 4_096
"""How many answers are remembered: trials from the same state ask the same."""
Goal = tuple[Literal, ...]
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
        reason = self._fewest(state, goal, most_states).reason
        return None if reason == "budget" else reason is None

    def _search(self, state: int, goal: Goal, most_states: int) -> Minimal:
        """The fewest actions, without their units; where they are not known, why."""
        try:
            plan = cheapest_plan(self._problem(state, goal), most_states=most_states)
        except BudgetError:
            return Minimal(None, None, "budget")
        return Minimal(None, None, "no plan") if plan is None else Minimal(len(plan), None, None)

    def _minimal(self, state: int, goal: Goal, most_states: int) -> Minimal:
        """The least that achieves the goal from the state.

        Where the budget suffices for the actions and not for the units, only these are unknown.
        """
        fewest = self._fewest(state, goal, most_states)
        if fewest.actions is None:
            return fewest
        try:
            plan = cheapest_plan(self._problem(state, goal), self._costs, most_states)
        except BudgetError:
            return fewest
        return fewest._replace(units=sum(self._costs.get(own, 0) for own in plan or ()))


class BudgetError(RuntimeError):
    """A search would have to look at more states than its budget allows."""


def cheapest_plan(
    problem: Problem, costs: Mapping[str, int] | None = None, most_states: int | None = None
) -> tuple[str, ...] | None:
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
            heuristic = _potentials(world).heuristic(initial, goal, price)
            current = [(n, s) for total, _, n, s in frontier if total == least[s]]
            frontier = [(least[s] + (left := heuristic(s)), left, n, s) for n, s in current]
            heapify(frontier)
    return None


def _path(came_from: Mapping[int, tuple[int, Action] | None], state: int) -> tuple[str, ...]:
    actions: list[Action] = []
    while (step := came_from[state]) is not None:
        state, action = step
        actions.append(action)
    return tuple(reversed(actions))


@lru_cache(maxsize=64)
def _potentials(world: World) -> Potentials:
    return Potentials(world.description)


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
