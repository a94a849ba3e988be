"""Shortest plans by breadth-first search over sets of states, without logic.

Sets of states are bits: the variables that most operators ask for make the *place* of a state, the
other variables number the states of one place, so that a set of states is one integer per place. An
operator leads from place to place, by masking and shifting all states at once.

It pays from the office of Table 1 on, whose trials take 1.8 times as long without.
"""

from collections import Counter
from collections.abc import Collection, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from itertools import product
from math import prod

from asp.language import Action, Fluent
from asp.reasoning.knowledge import Goal
from asp.reasoning.planning.large import outcomes
from asp.reasoning.planning.large.operators import Encoding, Operator, Values
from asp.reasoning.planning.reference import Plan
from asp.solving import current, preparation

StateSet = Mapping[int, int]
"""Of each place that has some of the states, these as bits."""

MOST_BITS = 2**17


@dataclass(frozen=True)
class Move:
    """What an operator does with the states of one place: mask, shift to the left, go."""

    action: Action
    to: int
    mask: int
    shift: int


class Space:
    """The states of an encoding, with the operators that change them."""

    def __init__(self, sizes: Sequence[int], operators: Iterable[Operator]) -> None:
        """`sizes` are the numbers of values of the variables."""
        changing = [operator for operator in operators if operator.after]
        outer, inner = _arranged(sizes, changing)
        self._sizes = sizes
        self._outer = _Numbering(sizes, outer)
        self._inner = _Numbering(sizes, inner)
        self._masks: dict[Values, int] = {(): (1 << self._inner.count) - 1}
        self.moves: dict[int, list[Move]] = {}
        for operator in changing:
            self._add(operator)

    def states(self, conditions: Iterable[outcomes.Literal]) -> dict[int, int]:
        """The states that satisfy conditions."""
        body = tuple(conditions)
        allowed = {v: outcomes.allowed(body, v, self._sizes[v]) for v, _, _ in body}
        inner = self._masks[()]
        for variable in self._inner.strides.keys() & allowed.keys():
            # Different values exclude each other, so that the sum is the union.
            inner &= sum(self._mask(((variable, value),)) for value in allowed[variable])
        return dict.fromkeys(self._outer.numbers(allowed), inner) if inner else {}

    def _add(self, operator: Operator) -> None:
        before = dict(operator.before)
        free = [v for v, _ in operator.after if v not in before]
        for values in product(*(range(self._sizes[v]) for v in free)):
            now = {**before, **dict(zip(free, values, strict=True))}
            mask = self._mask(tuple((v, x) for v, x in now.items() if v in self._inner.strides))
            shift = self._inner.difference(now, operator.after)
            step = self._outer.difference(now, operator.after)
            for place in self._outer.numbers({v: (x,) for v, x in now.items()}):
                self.moves.setdefault(place, []).append(
                    Move(operator.action, place + step, mask, shift)
                )

    def _mask(self, values: Values) -> int:
        """The states of a place in which variables have these values."""
        if values not in self._masks:
            *others, last = values
            mask = self._inner.mask(*last)
            self._masks[values] = mask & self._mask(tuple(others)) if others else mask
        return self._masks[values]


class _Numbering:
    """Numbers of the combinations of values of some variables."""

    def __init__(self, sizes: Sequence[int], variables: Sequence[int]) -> None:
        self.strides: dict[int, int] = {}
        self._sizes = sizes
        self.count = 1
        for variable in variables:
            self.strides[variable] = self.count
            self.count *= sizes[variable]

    def numbers(self, allowed: Mapping[int, Iterable[int]]) -> Iterator[int]:
        """The numbers of the combinations of allowed values; of other variables any."""
        choices = [
            [value * stride for value in allowed.get(variable, range(self._sizes[variable]))]
            for variable, stride in self.strides.items()
        ]
        return map(sum, product(*choices))

    def difference(self, before: Mapping[int, int], after: Iterable[tuple[int, int]]) -> int:
        """By how much the number grows when values change."""
        return sum(
            (value - before[variable]) * self.strides[variable]
            for variable, value in after
            if variable in self.strides
        )

    def mask(self, variable: int, value: int) -> int:
        """The combinations in which a variable has a value, as bits."""
        stride = self.strides[variable]
        period = stride * self._sizes[variable]
        every = ((1 << self.count) - 1) // ((1 << period) - 1)
        return ((((1 << stride) - 1) << (value * stride)) * every) if every else 0


class Search:
    """The way from one state to one goal, looked for layer by layer.

    It goes on where it was interrupted.
    """

    def __init__(
        self, space: Space, state: Sequence[int], goal: Iterable[outcomes.Literal]
    ) -> None:
        self._space = space
        self._goal = space.states(goal)
        start = space.states((v, x, True) for v, x in enumerate(state))
        self._reached: list[StateSet] = [start]
        self._new: StateSet = start

    def distance(self, limit: int | None) -> int | None:
        """The length of a shortest plan; None if there is none of at most `limit` actions.

        Raises LimitError.
        """
        while not any(states & self._goal.get(place, 0) for place, states in self._new.items()):
            if not self._new or len(self._reached) - 1 == limit:
                return None
            self._spend(self._new)
            self._advance()
        return len(self._reached) - 1

    def first_plan(self) -> Plan:
        """The first of the shortest plans in the order of actions, whose length was found.

        Raises LimitError.
        """
        ((place, state),) = self._reached[0].items()
        plan = []
        for after in [*self._backwards()][::-1]:
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
                if image := states & move.mask:
                    following[move.to] = following.get(move.to, 0) | _shifted(image, move.shift)
        new = {place: states & ~reached.get(place, 0) for place, states in following.items()}
        self._new = {place: states for place, states in new.items() if states}
        more = {place: reached.get(place, 0) | states for place, states in self._new.items()}
        self._reached.append({**reached, **more})

    def _spend(self, states: StateSet) -> None:
        """Takes the expansions that a step from these states needs. Raises LimitError."""
        current().take_expansions(sum(len(self._space.moves.get(place, ())) for place in states))

    def _backwards(self) -> Iterator[StateSet]:
        """The states on the way to the goal after each step, from the last step to the first."""
        left: StateSet = self._goal
        for reached in self._reached[-2::-1]:
            yield left
            self._spend(reached)
            left = self._before(reached, left)

    def _before(self, reached: StateSet, after: StateSet) -> StateSet:
        """The reached states from which an action leads to others."""
        before: dict[int, int] = {}
        for place, states in reached.items():
            for move in self._space.moves.get(place, ()):
                if target := after.get(move.to):
                    origin = _shifted(target, -move.shift) & move.mask & states
                    before[place] = before.get(place, 0) | origin
        return {place: states for place, states in before.items() if states}


class StateSpace:
    """The states of an encoding, in which its problems are searched; `size` is their number."""

    def __init__(self, encoding: Encoding) -> None:
        self._encoding = encoding
        self._sizes = [len(values) for values in encoding.domains]
        self.size = prod(self._sizes)

    def search(self, true: Collection[Fluent], goal: Goal) -> Search | None:
        """The search from a state, in which these fluents are true; None where it is none."""
        state = self._encoding.values(true)
        if state is None:
            return None
        return Search(self._space, state, map(self._encoding.assignment, goal))

    def succeeds(self, true: Collection[Fluent], goal: Goal, plan: Plan) -> bool | None:
        """Whether the goal holds after some of the plan's actions, all possible until then (36).

        None where the state is none of those that are searched.
        """
        state = self._encoding.values(true)
        if state is None:
            return None
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


def _arranged(sizes: Sequence[int], operators: Sequence[Operator]) -> tuple[list[int], list[int]]:
    """The variables that make the place of a state, and the others."""
    asked = Counter(variable for operator in operators for variable, _ in operator.before)
    order = sorted(range(len(sizes)), key=lambda variable: -asked[variable])
    outer = 0
    while outer < len(order) and (
        2 * asked[order[outer]] > len(operators)
        or prod(sizes[v] for v in order[outer:]) > MOST_BITS
    ):
        outer += 1
    return order[:outer], order[outer:]
