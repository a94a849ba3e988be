"""Whether a goal can still be achieved, asked of many states."""

from collections.abc import Iterable, Iterator
from heapq import heapify, heappop, heappush
from itertools import count
from typing import Any

from testbed.search.heuristic import Heuristic, blind
from testbed.search.plans import UNINFORMED, Goal, Pose, potentials_of
from testbed.world import World

MOST_REMEMBERED = 100_000
"""States whose answer is remembered, of a goal; then they are asked anew."""


class Reach:
    """Says of a state and a goal whether some plan of the robot achieves it: True or False.

    Of several outcomes of an action some have to. None where it is not known: the search would
    have to look at more than `most_states` states. An answer depends on the question alone, and not
    on what was asked before.
    """

    def __init__(self, pose: Pose, most_states: int) -> None:
        self._pose, self._most_states = pose, most_states
        self._known: dict[tuple[World, Goal], _Known] = {}

    def __reduce__(self) -> tuple[Any, ...]:
        """Copies begin without what is remembered."""
        return type(self), (self._pose, self._most_states)

    def __call__(self, state: int, goal: Goal) -> bool | None:
        world, start, left = self._pose(state, goal)
        known = self._known.setdefault((world, left), _Known(world, left, self._most_states))
        return known.answer(start)


class _Known:
    """The answers about one goal in one world."""

    def __init__(self, world: World, goal: Goal, most_states: int) -> None:
        self._world, self._goal, self._most_states = world, goal, most_states
        self._costs: dict[str, int] = dict.fromkeys(world.agent_actions, 1)
        self._answers: dict[int, bool | None] = {}
        self._after: dict[int, tuple[int, ...]] = {}

    def answer(self, start: int) -> bool | None:
        if start not in self._answers:
            if len(self._after) > MOST_REMEMBERED or len(self._answers) > MOST_REMEMBERED:
                self._answers, self._after = {}, {}
            seen = {start}
            self._answers[start] = self._search(start, seen)
            if self._answers[start] is False:
                # No state that is reached from here leads further, and a search from it ends, too.
                self._answers.update(dict.fromkeys(seen, False))
        return self._answers[start]

    def _search(self, start: int, seen: set[int]) -> bool | None:
        """Greedy search for the goal from the state, which is in `seen`; all found is put there.

        First comes the state at which the fewest literals of the goal are missing, and in a search
        that is not over soon the one with the lowest bound on the actions that are left.
        """
        number = count()
        heuristic: Heuristic = blind
        frontier = [(0, self._missing(start), next(number), start)]
        for expanded in count():
            if not frontier:
                return False
            _, missing, _, state = heappop(frontier)
            if not missing:
                return True
            if expanded == self._most_states:
                return None
            if expanded == UNINFORMED:
                heuristic = potentials_of(self._world).heuristic(start, self._goal, self._costs)
                frontier = [(heuristic(own), lack, n, own) for _, lack, n, own in frontier]
                heapify(frontier)
            for reached in self._successors(state):
                if reached not in seen:
                    seen.add(reached)
                    ahead = heuristic(reached), self._missing(reached), next(number), reached
                    heappush(frontier, ahead)
        raise AssertionError("counting does not end")

    def _missing(self, state: int) -> int:
        return sum(not self._world.holds(state, literal) for literal in self._goal)

    def _successors(self, state: int) -> Iterable[int]:
        if state not in self._after:
            self._after[state] = tuple(dict.fromkeys(self._reached(state)))
        return self._after[state]

    def _reached(self, state: int) -> Iterator[int]:
        return (reached for _, reached in self._world.moves(state))
