"""How far a goal is from a state, and which actions can be on the way: search without logic.

Breadth-first over sets of states (`asp.reasoning.planning.large.state_sets`), in the space of all
variables where it is small enough, else in several spaces of some variables each, in which
everything is at most as far. In the space of all variables the search gives the plan itself.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Collection, Iterable, Iterator, Sequence
from functools import cached_property
from math import prod

from asp.reasoning.planning.large.operators import Encoding
from asp.reasoning.planning.large.state_sets import Space, StateSet
from asp.solving import Recent, preparation

MOST_SPACES = 16
"""How many spaces of an encoding are kept: those that were used last."""

Condition = tuple[int, int, bool]

Spend = Callable[[int], None]
"""Called before so many applications of an operator to a set of states; it may raise."""

Steps = tuple[frozenset[str], ...]
"""Of each step of a plan, the actions that may be taken there."""


class Search:
    """The way from one state to one goal in one space, looked for layer by layer.

    It goes on where it was interrupted.
    """

    def __init__(self, space: Space, state: Sequence[int], goal: Sequence[Condition]) -> None:
        self._space = space
        start = space.states([(v, x, True) for v, x in enumerate(state)])
        self._goal = space.states(goal)
        self._reached: list[StateSet] = [start]
        self._new: StateSet = start
        self._distance: int | None = None

    def distance(self, limit: int | None, spend: Spend) -> int | None:
        """No plan is shorter; None if there is no plan of at most `limit`.

        Once it is found it stays, however far `steps` has looked since.
        """
        while self._distance is None:
            layer = len(self._reached) - 1
            if _meets(self._new, self._goal):
                self._distance = layer
            elif not self._new or layer == limit:
                return None
            else:
                spend(self._moves(self._new))
                self.advance()
        return self._distance

    def advance(self) -> None:
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

    def steps(self, length: int, spend: Spend) -> list[set[str]]:
        """Of each step of a plan of this length, the actions that the space knows and allows there.

        Standing still counts as no action: it is what actions do that the space knows nothing of.
        """
        found = [actions for actions, _ in self._backwards(length, spend)]
        return [{self._space.actions[action] for action in actions} for actions in found[::-1]]

    def first_plan(self, length: int, spend: Spend) -> tuple[str, ...]:
        """The first plan in the order of actions, of the length that `distance` found.

        In the space of all variables, where moves are what actions do.
        """
        on_the_way = [states for _, states in self._backwards(length, spend)][::-1]
        ((place, state),) = self._reached[0].items()
        plan = []
        for after in [*on_the_way[1:], self._goal][:length]:
            action, place, state = next(
                (move.action, move.to, image)
                for move in self._space.moves[place]
                if (image := _shifted(state & move.mask, move.shift)) & after.get(move.to, 0)
            )
            plan.append(self._space.actions[action])
        return tuple(plan)

    def _backwards(self, length: int, spend: Spend) -> Iterator[tuple[set[int], StateSet]]:
        """From the last step to the first: actions on the way to the goal, the states before."""
        while len(self._reached) <= length:
            spend(self._moves(self._new))
            self.advance()
        left: StateSet = _common(self._reached[length], self._goal)
        for step in reversed(range(length)):
            spend(self._moves(self._reached[step]))
            actions, left = self._before(self._reached[step], left)
            yield actions, left

    def _moves(self, states: StateSet) -> int:
        """How many applications of operators a step from these states takes."""
        return sum(len(self._space.moves.get(place, ())) for place in states)

    def _before(self, reached: StateSet, after: StateSet) -> tuple[set[int], StateSet]:
        """The actions from reached states to others, and the reached states of these or others."""
        before = _common(reached, after)
        actions: set[int] = set()
        for place, states in reached.items():
            for move in self._space.moves.get(place, ()):
                target = after.get(move.to)
                if not target:
                    continue
                origin = _shifted(target, -move.shift) & move.mask & states
                if origin:
                    actions.add(move.action)
                    before[place] = before.get(place, 0) | origin
        return actions, {place: states for place, states in before.items() if states}


class Bounds:
    """What searches tell of a planning problem: a least length, and what such plans consist of."""

    def __init__(
        self,
        spaces: Sequence[Space],
        state: Sequence[int],
        goal: Sequence[Condition],
        exact: bool,
    ) -> None:
        """`exact` if there is one space, of all variables: then `least` is the length of a plan."""
        self._searches = [(space, Search(space, state, goal)) for space in spaces]
        self.exact = exact

    def least(self, limit: int | None, spend: Spend) -> int | None:
        """A length that no plan is shorter than; None if there is no plan of at most `limit`.

        Where `spend` raises, the next call goes on from there.
        """
        least = 0
        for _, search in self._searches:
            distance = search.distance(limit, spend)
            if distance is None:
                return None
            least = max(least, distance)
        return least

    def steps(self, length: int, spend: Spend) -> Steps:
        """Of each step the actions that a shortest plan may take there if it has this length."""
        allowed = [
            [known | space.elsewhere for known in search.steps(length, spend)]
            for space, search in self._searches
        ]
        return tuple(
            frozenset.intersection(*map(frozenset, step)) for step in zip(*allowed, strict=True)
        )

    def first_plan(self, length: int, spend: Spend) -> tuple[str, ...]:
        """The first of the shortest plans, whose length `least` found in an exact space."""
        ((_, search),) = self._searches
        return search.first_plan(length, spend)


class Spaces:
    """The spaces in which problems of an encoding are searched."""

    def __init__(self, encoding: Encoding, most_states: int) -> None:
        """`most_states` is the size of the largest space that may be searched."""
        self._encoding = encoding
        self._sizes = [len(values) for values in encoding.domains]
        self._most = most_states
        self._kept: Recent[tuple[int, ...], Space] = Recent(MOST_SPACES)
        self.exact = prod(self._sizes) <= most_states

    def bounds(self, true: Collection[str], goal: Iterable[str]) -> Bounds | None:
        """What searches tell of a problem; None where the fluents are not those of a state."""
        state = self._encoding.values(true)
        if state is None:
            return None
        wanted = [self._encoding.assignment(literal) for literal in goal]
        variables = self._chosen([variable for variable, _, _ in wanted])
        return Bounds([self._space(some) for some in variables], state, wanted, self.exact)

    def succeeds(self, true: Collection[str], goal: Iterable[str], plan: Iterable[str]) -> bool:
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

    def _space(self, variables: tuple[int, ...]) -> Space:
        return self._kept.get(variables, lambda: self._make_space(variables))

    def _make_space(self, variables: tuple[int, ...]) -> Space:
        # Like grounding, which it stands for: made once, not interrupted, no part of reasoning.
        with preparation():
            return Space(self._sizes, self._encoding.operators, variables)

    def _chosen(self, wanted: Iterable[int]) -> list[tuple[int, ...]]:
        """All variables, or several sets in which each wanted one occurs beside the busiest."""
        if self.exact:
            return [tuple(range(len(self._sizes)))]
        busy = self._filled([], self._busy[: len(self._busy) // 2 + 1], self._most // 64)
        left = [variable for variable in dict.fromkeys(wanted) if variable not in busy]
        found: list[tuple[int, ...]] = []
        while left or not found:
            chosen = self._filled(busy, left, self._most)
            left = [v for v in left[1:] if v not in chosen]
            found.append(tuple(sorted(self._filled(chosen, self._busy, self._most))))
        return found

    def _filled(self, chosen: Sequence[int], more: Iterable[int], most: int) -> list[int]:
        """The chosen variables and as many more as fit."""
        found = list(chosen)
        for variable in more:
            if variable not in found and prod(self._sizes[v] for v in (*found, variable)) <= most:
                found.append(variable)
        return found

    @cached_property
    def _busy(self) -> list[int]:
        """The variables, those first that the most operators change."""
        changed = Counter(
            variable for operator in self._encoding.operators for variable, _ in operator.after
        )
        return sorted(range(len(self._sizes)), key=lambda variable: -changed[variable])


def _shifted(states: int, by: int) -> int:
    return states << by if by >= 0 else states >> -by


def _meets(some: StateSet, others: StateSet) -> bool:
    return any(states & others.get(place, 0) for place, states in some.items())


def _common(some: StateSet, others: StateSet) -> dict[int, int]:
    return {place: states & others.get(place, 0) for place, states in some.items()}
