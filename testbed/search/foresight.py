"""The least that achieves a goal for who knows beforehand what others do, and when."""

from collections import defaultdict
from collections.abc import Iterator, Mapping, Sequence
from functools import lru_cache
from math import inf

from asp.language import Action
from testbed.search.plans import BudgetError, Problem
from testbed.world import World

MOST_REMEMBERED = 8_192
"""States whose moves are remembered: those of a step, or of all of a small world."""


def least_knowing(
    problem: Problem,
    events: Sequence[tuple[int, Action]],
    costs: Mapping[str, int],
    most_states: int,
) -> int | None:
    """The least cost of a plan to a state of the goal beside the events; None: there is no plan.

    `events` are steps, from 1 on and ascending, each with what happens at it. At a step the plan
    has an action of the robot, or waits, which costs nothing; it may end before the last event. An
    event that is impossible beside the action does not happen. Of several outcomes the best counts.
    What has no cost costs 0. Raises BudgetError where at some step more than `most_states` states
    would have to be looked at.
    """
    search, step = _Layers(problem, costs, most_states), 1
    for when, event in events:
        search.spread(when - step)
        search.beside(event)
        step = when + 1
    search.spread(None)
    return None if search.best == inf else int(search.best)


class _Layers:
    """A search of the world expanded by time: `least` is what each state costs at the step.

    `best` is the least that a state of the goal has cost so far. What costs as much is left out.
    """

    def __init__(self, problem: Problem, costs: Mapping[str, int], most_states: int) -> None:
        self._world, initial, self._goal = problem
        self._costs, self._most_states = costs, most_states
        self.best: float = inf
        self.least: dict[int, float] = {}
        self._take({initial: 0.0})

    def _take(self, found: Mapping[int, float]) -> dict[int, float]:
        """Those of the states, which are taken in, that may lead to something better."""
        met = (cost for s, cost in found.items() if self._world.satisfies(s, self._goal))
        self.best = min(self.best, *met, inf)
        self.least.update(found)
        if len(self.least) > self._most_states:
            raise BudgetError(f"more than {self._most_states} states")
        return self._open(found)

    def _open(self, states: Mapping[int, float]) -> dict[int, float]:
        return {state: cost for state, cost in states.items() if cost < self.best}

    def spread(self, steps: int | None) -> None:
        """So many steps at which nothing happens besides; None: as many as there is use of."""
        improved, taken = self._open(self.least), 0
        while improved and taken != steps:
            cheaper: dict[int, float] = {}
            for state, spent in improved.items():
                for action, reached in _moves(self._world, state):
                    cost = spent + self._costs.get(action, 0)
                    if cost < min(cheaper.get(reached, inf), self.least.get(reached, inf)):
                        cheaper[reached] = cost
            improved, taken = self._take(cheaper), taken + 1

    def beside(self, event: Action) -> None:
        """A step at which the event happens."""
        before, self.least = self._open(self.least), {}
        after: dict[int, float] = {}
        for state, spent in before.items():
            for cost, reached in self._beside(state, event):
                after[reached] = min(spent + cost, after.get(reached, inf))
        self._take(after)

    def _beside(self, state: int, event: Action) -> Iterator[tuple[int, int]]:
        """What the robot can make of a step with the event: a cost, and the state after it."""
        world = self._world
        for reached in world.successors(state, (event,)) or world.successors(state, ()):
            yield 0, reached
        alone, together = defaultdict[Action, list[int]](list), defaultdict[Action, list[int]](list)
        for action, reached in _moves(world, state):
            alone[action].append(reached)
        for action, reached in _moves(world, state, event):
            together[action].append(reached)
        # What others do does not make an action possible that is impossible by itself.
        for action, states in alone.items():
            for reached in together.get(action, states):
                yield self._costs.get(action, 0), reached


@lru_cache(MOST_REMEMBERED)
def _moves(world: World, state: int, *beside: Action) -> tuple[tuple[Action, int], ...]:
    return tuple(world.moves(state, beside))
