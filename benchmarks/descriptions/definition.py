"""The transition diagram of a description by its definition: every set of literals is tried.

A state is closed under the constraints, and what is defined is true in it only where it is derived.
A successor is the closure of the direct effects and of what inertia keeps.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from functools import cache, cached_property
from typing import TypeAlias

from benchmarks.descriptions.grounding import Grounding, Instance
from benchmarks.descriptions.text import Description

State: TypeAlias = frozenset[str]
"""The fluents that are true."""
Goal: TypeAlias = tuple[str, ...]
Plan: TypeAlias = tuple[str, ...]


class Definition:
    """What a description means.

    Inside, sets of literals are bit masks: with n fluents, bit i is the literal f_i and bit n + i
    is -f_i. `own` and `others` are the actions of the agent and exogenous ones.
    """

    def __init__(self, description: Description) -> None:
        self._ground = Grounding(description)
        self.inertial = description.atoms("inertial")
        self.fluents = (*self.inertial, *description.atoms("defined"))
        self.own, self.others = description.atoms("agent"), description.atoms("exogenous")
        self._positive = (1 << len(self.fluents)) - 1
        self._bits = {fluent: 1 << n for n, fluent in enumerate(self.fluents)}
        self._bits |= {f"-{f}": bit << len(self.fluents) for f, bit in self._bits.items()}
        self._kept = self._mask(sign + each for each in self.inertial for sign in ("", "-"))
        self._closed_world = self._mask(f"-{each}" for each in self.fluents) & ~self._kept
        self._constraints = [(self._mask(i.body), self._bits[i.heads[0]]) for i in self._all("law")]
        self._effects = [
            (i.heads[0], self._mask(i.body), self._bits[i.heads[1]]) for i in self._all("causes")
        ]
        self._impossible = [({*i.heads}, self._mask(i.body)) for i in self._all("impossible")]
        self._seen = [(i.heads[0], self._mask(i.body)) for i in self._all("sees")]
        self.after = cache(self._after)
        self._distances = cache(self._all_distances)

    @cached_property
    def states(self) -> tuple[State, ...]:
        """Every state: true fluents come before false ones, those declared first before others."""
        return tuple(sorted(self._masks, key=lambda state: [f not in state for f in self.fluents]))

    @cached_property
    def _masks(self) -> dict[State, int]:
        """All the literals of each state."""
        every = (m | (self._positive & ~m) << len(self.fluents) for m in range(self._positive + 1))
        given = self._kept | self._closed_world
        found = [mask for mask in every if self._closure(mask & given) == mask]
        return {frozenset(f for f in self.fluents if m & self._bits[f]): m for m in found}

    @cached_property
    def initial(self) -> tuple[State, ...]:
        """The states that have all that an initial one must have."""
        groups: dict[object, set[str]] = {}
        for statement, one in self._ground.instances("some"):
            others = tuple(v for name, v in one.binding.items() if name != statement.name)
            groups.setdefault((statement, others), set()).update(one.heads)
        return tuple(s for s in self.states if all(s & some for some in groups.values()))

    def satisfies(self, state: State, literals: Iterable[str]) -> bool:
        """Whether the literals are true in a state."""
        return not self._mask(literals) & ~self._masks[state]

    def visible(self, state: State) -> frozenset[str]:
        """The literals that the robot sees in a state."""
        seen = (fluent for fluent, body in self._seen if not body & ~self._masks[state])
        return frozenset(each if each in state else f"-{each}" for each in seen)

    def forbidden(self, state: State, actions: frozenset[str], alone: bool = False) -> bool:
        """Whether a law says that actions are impossible together; if `alone`, one about all."""
        now = self._masks[state]
        return any(
            (some == actions if alone else some <= actions) and not body & ~now
            for some, body in self._impossible
        )

    def _after(self, state: State, actions: frozenset[str]) -> frozenset[State]:
        """The states that these actions, all at once, may lead to."""
        now, effects = self._masks[state], 0
        if self.forbidden(state, actions):
            return frozenset()
        for action, body, head in self._effects:
            if action in actions and not body & ~now:
                effects |= head
        given = now & self._kept | self._closed_world
        return frozenset(
            following
            for following, then in self._masks.items()
            if not effects & ~then and self._closure(effects | given & then) == then
        )

    @cached_property
    def defaults(self) -> dict[str, Instance]:
        """The defaults by name, in the order of declaration, but those that are always excepted."""
        every = ((one.name, one) for _, one in self._ground.instances("default"))
        return {name: one for name, one in every if () not in self._excepted.get(name, ())}

    @cached_property
    def _excepted(self) -> dict[str, list[tuple[str, ...]]]:
        """The conditions under which a default says nothing, by its name."""
        found: dict[str, list[tuple[str, ...]]] = {}
        for _, one in self._ground.instances("exception"):
            found.setdefault(one.name, []).append(one.body)
        return found

    def exceptions(self, state: State) -> tuple[str, ...]:
        """The defaults that are in force in an initial state, and whose conclusion is false."""
        return tuple(
            name
            for name, one in self.defaults.items()
            if self.satisfies(state, one.body)
            and not any(self.satisfies(state, body) for body in self._excepted.get(name, ()))
            and not self.satisfies(state, one.heads)
        )

    def plan(self, state: State, goal: Goal) -> Plan | None:
        """The first shortest sequence of the agent's actions that may lead to the goal.

        The first in the order of declaration; None where none of any length does.
        """
        distance = self._distances(goal).get(state)
        if distance is None:
            return None
        plan, now = list[str](), {state}
        while distance > 0:
            distance -= 1
            action, now = next(self._nearer(now, goal, distance))
            plan.append(action)
        return tuple(plan)

    def conformant_plan(self, state: State, goal: Goal, most: int) -> Plan | None:
        """The first shortest sequence of actions that leads to the goal whatever the outcomes.

        Each action is possible after whatever the outcomes before it; None where no sequence of at
        most so many actions is one.
        """
        plans: dict[frozenset[State], Plan] = {frozenset([state]): ()}
        for _ in range(most + 1):
            for states, plan in plans.items():
                if all(self.satisfies(each, goal) for each in states):
                    return plan
            longer: dict[frozenset[State], Plan] = {}
            for states, plan in plans.items():
                for action in self.own:
                    outcomes = [self.after(each, frozenset([action])) for each in states]
                    if all(outcomes):
                        longer.setdefault(frozenset().union(*outcomes), (*plan, action))
            plans = longer
        return None

    def _nearer(
        self, now: set[State], goal: Goal, distance: int
    ) -> Iterator[tuple[str, set[State]]]:
        """The actions that may lead to a distance from the goal, with the states at it."""
        for action in self.own:
            reached = {after for each in now for after in self.after(each, frozenset([action]))}
            nearer = {each for each in reached if self._distances(goal).get(each) == distance}
            if nearer:
                yield action, nearer

    def _all_distances(self, goal: Goal) -> dict[State, int]:
        """How many actions may lead to a goal at least, of the states from which some may."""
        found: dict[State, int] = {}
        new, length = [state for state in self.states if self.satisfies(state, goal)], 0
        while new:
            found |= dict.fromkeys(new, length)
            length += 1
            new = [
                state for state in self.states if state not in found and self._leads(state, found)
            ]
        return found

    def _leads(self, state: State, where: Iterable[State]) -> bool:
        """Whether some action of the agent's may lead from a state to one of others."""
        return any(after in where for a in self.own for after in self.after(state, frozenset([a])))

    def _all(self, kind: str) -> Iterator[Instance]:
        return (instance for _, instance in self._ground.instances(kind))

    def _mask(self, literals: Iterable[str]) -> int:
        return sum(self._bits[each] for each in {*literals})

    def _closure(self, literals: int) -> int:
        """The least superset that is closed under the constraints; it may be inconsistent."""
        before = -1
        while before != literals:
            before = literals
            for body, head in self._constraints:
                if not body & ~literals:
                    literals |= head
        return literals
