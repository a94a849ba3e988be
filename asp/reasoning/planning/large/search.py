"""Shortest plans by breadth-first search over sets of states, without logic.

It pays from the office of Table 1 on, whose trials take 1.8 times as long without.
"""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterable, Iterator, Sequence
from functools import cached_property
from math import prod

from asp.language import Action, Fluent, Literal
from asp.reasoning.planning.large.operators import Encoding
from asp.reasoning.planning.large.state_sets import Space, StateSet
from asp.solving import preparation

Condition = tuple[int, int, bool]

Spend = Callable[[int], None]
"""Called before so many applications of an operator to a set of states; it may raise."""


class Search:
    """The way from one state to one goal, looked for layer by layer.

    It goes on where it was interrupted.
    """

    def __init__(self, space: Space, state: Sequence[int], goal: Iterable[Condition]) -> None:
        self._space = space
        self._goal = space.states(goal)
        start = space.states((v, x, True) for v, x in enumerate(state))
        self._reached: list[StateSet] = [start]
        self._new: StateSet = start

    def distance(self, limit: int | None, spend: Spend) -> int | None:
        """The length of a shortest plan; None if there is none of at most `limit` actions."""
        while not _meets(self._new, self._goal):
            if not self._new or len(self._reached) - 1 == limit:
                return None
            spend(self._moves(self._new))
            self._advance()
        return len(self._reached) - 1

    def first_plan(self, spend: Spend) -> tuple[Action, ...]:
        """The first of the shortest plans in the order of actions, whose length was found."""
        ((place, state),) = self._reached[0].items()
        plan = []
        for after in [*self._backwards(spend)][::-1]:
            action, place, state = next(
                (move.action, move.to, image)
                for move in self._space.moves[place]
                if (image := _shifted(state & move.mask, move.shift)) & after.get(move.to, 0)
            )
            plan.append(action)
        return tuple(plan)

    def _advance(self) -> None:
        """One layer more: the states that take one action more than all that were reached."""
        reached = self._reached[-1]
        following: dict[int, int] = {}
        for place, states in self._new.items():
            for move in self._space.moves.get(place, ()):
                image = states & move.mask
                if image:
                    following[move.to] = following.get(move.to, 0) | _shifted(image, move.shift)
        new = {place: states & ~reached.get(place, 0) for place, states in following.items()}
        self._new = {place: states for place, states in new.items() if states}
        more = {place: reached.get(place, 0) | states for place, states in self._new.items()}
        self._reached.append({**reached, **more})

    def _moves(self, states: StateSet) -> int:
        """How many applications of operators a step from these states takes."""
        return sum(len(self._space.moves.get(place, ())) for place in states)

    def _backwards(self, spend: Spend) -> Iterator[StateSet]:
        """The states on the way to the goal after each step, from the last step to the first."""
        left: StateSet = self._goal
        for reached in self._reached[-2::-1]:
            yield left
            spend(self._moves(reached))
            left = self._before(reached, left)

    def _before(self, reached: StateSet, after: StateSet) -> StateSet:
        """The reached states from which an action leads to others."""
        before: dict[int, int] = {}
        for place, states in reached.items():
            for move in self._space.moves.get(place, ()):
                target = after.get(move.to)
                if target:
                    origin = _shifted(target, -move.shift) & move.mask & states
                    before[place] = before.get(place, 0) | origin
        return {place: states for place, states in before.items() if states}


class StateSpace:
    """The states of an encoding, in which its problems are searched; `size` is their number."""

    def __init__(self, encoding: Encoding) -> None:
        self._encoding = encoding
        self._sizes = [len(values) for values in encoding.domains]
        self.size = prod(self._sizes)

    def search(self, true: Collection[Fluent], goal: Iterable[Literal]) -> Search | None:
        """The search from a state, in which these fluents are true; None where it is none."""
        state = self._encoding.values(true)
        if state is None:
            return None
        return Search(self._space, state, map(self._encoding.assignment, goal))

    def succeeds(
        self, true: Collection[Fluent], goal: Iterable[Literal], plan: Iterable[Action]
    ) -> bool:
        """Whether the goal holds after some of the plan's actions, all possible until then (36)."""
        state = self._encoding.values(true)
        wanted = [self._encoding.assignment(literal) for literal in goal]
        for action in plan:
            state = None if state is None else self._encoding.after(state, action)
            if state is None:
                return False
            if all((state[variable] == value) == truth for variable, value, truth in wanted):
                return True
        return False

    @cached_property
    def _space(self) -> Space:
        # Like grounding, which it stands for: made once, not interrupted, no part of reasoning.
        with preparation():
            return Space(self._sizes, self._encoding.operators)


def _shifted(states: int, by: int) -> int:
    return states << by if by >= 0 else states >> -by


def _meets(some: StateSet, others: StateSet) -> bool:
    return any(states & others.get(place, 0) for place, states in some.items())
