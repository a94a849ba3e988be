"""What one action can change, whatever the state: the answer sets of a program of one step.

The program is made of the ground laws that the world is compiled from, and of no other program.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from typing import NamedTuple

from clingo import Symbol

from asp.language import Description, Fluent, Literal
from asp.solving import (
    BudgetError,
    Limits,
    answer_sets,
    deciding,
    fact,
    ground,
    is_satisfiable,
)

MOST_CHANGES = 5_000
MOST_CONFLICTS = 100_000


class Effect(NamedTuple):
    """The values of a variable before and after."""

    variable: int
    before: int
    after: int


@dataclass(frozen=True)
class Changes:
    """Each action of the agents with what it does to all variables at once, in every way.

    These are the changes of states in which each mask of `covered` has a true fluent; no action
    leads out of them.
    """

    covered: tuple[int, ...]
    found: tuple[tuple[str, tuple[Effect, ...]], ...]

    def cover(self, state: int) -> bool:
        """Whether they are all that can happen from the state on."""
        return all(state & some for some in self.covered)


def changes(description: Description, variables: Sequence[int]) -> Changes | None:
    """All changes of the variables; None where there are too many of them, or they take too long.

    Where no action leads out of the states that have all of `initially`, only these are looked at.
    """
    step = _Step(description, variables)
    covered = tuple(sum(map(step.fluent, some)) for some in description.initially)
    try:
        with deciding(Limits(conflicts=MOST_CONFLICTS)):
            if is_satisfiable(step.control, [step.within, step.leaves]):
                covered = ()
            within = step.within if covered else -step.within
            found, more = answer_sets(step.control, [within], MOST_CHANGES)
    except BudgetError:
        return None
    return None if more else Changes(covered, tuple(sorted(map(step.change, found))))


class _Step:
    """The program: a state, an action in it, and a state after it.

    Its answer sets show the action and, of each variable that changes, both values. `within` says
    that the state has all of `initially`, `leaves` that it has and the one after it has not.
    """

    def __init__(self, description: Description, variables: Sequence[int]) -> None:
        self.control = ground([], {}, [])
        self._description, self._variables = description, variables
        self._numbers: dict[str, int] = {
            fluent: number for number, fluent in enumerate(description.fluents)
        }
        with self.control.backend() as backend:
            self._backend, self._rule = backend, backend.add_rule
            # By time, 0 and 1: atoms of the fluents, and of their negations.
            self._true, self._false = (
                [[backend.add_atom() for _ in self._numbers] for _ in range(2)] for _ in range(2)
            )
            self._states()
            self._transition()
            for number, variable in enumerate(variables):
                self._show(number, variable)
            self.within, self.leaves = backend.add_atom(), backend.add_atom()
            self._initially()

    def fluent(self, fluent: Fluent) -> int:
        """Its mask."""
        return 1 << self._numbers[fluent]

    def change(self, shown: Iterable[Symbol]) -> tuple[str, tuple[Effect, ...]]:
        """What an answer set shows."""
        action, values = "", dict[int, list[int]]()
        for symbol in shown:
            first, *rest = (argument.number for argument in symbol.arguments)
            if symbol.name == "occurs":
                action = self._description.agent_actions[first]
                continue
            own = values.setdefault(self._variables[first], [0, 0])
            if rest:
                time, number = rest
                own[time] |= 1 << number
        return action, tuple(Effect(variable, *own) for variable, own in sorted(values.items()))

    def _literals(self, literals: Iterable[Literal], time: int) -> Iterator[int]:
        for literal in literals:
            atoms = self._true if literal.is_positive else self._false
            yield atoms[time][self._numbers[literal.atom]]

    def _states(self) -> None:
        """Inertial fluents are anything at first; both states are closed under the constraints."""
        self._rule([*self._literals(self._description.inertial, 0)], choice=True)
        for time in range(2):
            for law in self._description.constraints:
                self._rule([*self._literals([law.head], time)], [*self._literals(law.body, time)])
            for true, false in zip(self._true[time], self._false[time], strict=True):
                self._rule([], [true, false])
        for true, false in zip(self._true[0], self._false[0], strict=True):
            self._rule([false], [-true])

    def _transition(self) -> None:
        """One action, that is not impossible; its effects, and inertia."""
        actions = self._description.agent_actions
        occurs = {
            action: self._backend.add_atom(fact("occurs", number))
            for number, action in enumerate(actions)
        }
        some, several = self._backend.add_atom(), self._backend.add_atom()
        self._rule([*occurs.values()], choice=True)
        for bound, least in (some, 1), (several, 2):
            self._backend.add_weight_rule([bound], least, [(a, 1) for a in occurs.values()])
        self._rule([], [-some])
        self._rule([], [several])
        for law in self._description.causal:
            if law.action in occurs:
                body = [occurs[law.action], *self._literals(law.body, 0)]
                self._rule([*self._literals([law.head], 1)], body)
        for condition in self._description.executability:
            if len(condition.actions) == 1 and condition.actions[0] in occurs:
                body = [occurs[condition.actions[0]], *self._literals(condition.body, 0)]
                self._rule([], body)
        for number in map(self._numbers.__getitem__, self._description.inertial):
            true, false = self._true[1][number], self._false[1][number]
            self._rule([true], [self._true[0][number], -false])
            self._rule([false], [self._false[0][number], -true])
        for number in map(self._numbers.__getitem__, self._description.defined):
            self._rule([self._false[1][number]], [-self._true[1][number]])

    def _show(self, number: int, variable: int) -> None:
        own = [n for n in self._numbers.values() if variable >> n & 1]
        changes = self._backend.add_atom(fact("changes", number))
        for n in own:
            self._rule([changes], [self._true[0][n], self._false[1][n]])
            self._rule([changes], [self._false[0][n], self._true[1][n]])
        for time in range(2):
            for n in own:
                shown = self._backend.add_atom(fact("value", number, time, n))
                self._rule([shown], [changes, self._true[time][n]])

    def _initially(self) -> None:
        self._rule([self.within], choice=True)
        for some in self._description.initially:
            before, after = ([-a for a in self._literals(some, time)] for time in range(2))
            self._rule([], [self.within, *before])
            self._rule([self.leaves], [self.within, *after])
