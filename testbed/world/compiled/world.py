"""The transition function of a domain, compiled from its ground description (P 3.1.1).

A successor is the closure, under the state constraints, of the direct effects and of what inertia
keeps; a compound action without one cannot be executed.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from asp.language import Description
from testbed.world.closure import Rule
from testbed.world.compiled.states import StateSpace
from testbed.world.errors import NotExecutableError, UnknownActionError

_Condition = tuple[int, frozenset[str], int]
"""The number of a law, actions that cannot occur together, the literals under which they cannot."""


class World(StateSpace):
    """The states of a description, its transitions, and what a robot sees of a state.

    Everything is a pure function of the state; successors are remembered.
    """

    def __init__(self, description: Description) -> None:
        super().__init__(description)
        self.agent_actions: tuple[str, ...] = description.agent_actions
        self.exogenous_actions: tuple[str, ...] = description.exogenous_actions
        mask, bit = self._vocabulary.mask, self._vocabulary.bit
        actions = (*self.agent_actions, *self.exogenous_actions)
        self._effects: dict[str, list[Rule]] = {action: [] for action in actions}
        for law in description.causal:
            self._effects[law.action].append(Rule(mask(law.body), bit(law.head)))
        self._impossible: dict[str, list[_Condition]] = {}
        for number, condition in enumerate(description.executability):
            own = number, frozenset(condition.actions), mask(condition.body)
            self._impossible.setdefault(min(condition.actions), []).append(own)
        self._sees: dict[str, list[Rule]] = {}
        for sight in description.sees:
            seen = Rule(mask(sight.body), bit(sight.fluent))
            self._sees.setdefault(sight.robot, []).append(seen)
        self._known: dict[tuple[int, frozenset[str]], tuple[int, ...]] = {}

    def successors(self, state: int, actions: Iterable[str]) -> tuple[int, ...]:
        """Every state the compound action can lead to, sorted; none: it cannot be executed.

        Raises UnknownActionError. The empty compound action is one, too.
        """
        compound = frozenset(actions)
        key = (state, compound)
        if key not in self._known:
            self._known[key] = self._compute(state, compound)
        return self._known[key]

    def moves(self, state: int) -> Iterator[tuple[str, int]]:
        """Each action of the agents that can be executed, with each state it can lead to.

        In the order of declaration. Nothing is remembered: this is for searches, whose memory would
        grow with all actions of every state that they look at.
        """
        for action in self.agent_actions:
            for reached in self._compute(state, frozenset([action])):
                yield action, reached

    def successor(self, state: int, actions: Iterable[str]) -> int:
        """The one successor. Raises NotExecutableError, or ValueError where there are several."""
        compound = frozenset(actions)
        found = self.successors(state, compound)
        if not found:
            raise NotExecutableError(self.why_not(state, compound))
        if len(found) > 1:
            outcomes = " | ".join(" ".join(self.true_atoms(s)) for s in found)
            raise ValueError(f"{_names(compound)} has several outcomes: {outcomes}")
        return found[0]

    def executable(self, state: int, actions: Iterable[str]) -> bool:
        """Whether the compound action has a successor. Raises UnknownActionError."""
        return bool(self.successors(state, actions))

    def why_not(self, state: int, actions: Iterable[str]) -> str | None:
        """One line that says why the compound action cannot be executed; None if it can."""
        compound = frozenset(actions)
        if self.executable(state, compound):
            return None
        first = min(self._forbidding(self._vocabulary.complete(state), compound), default=None)
        if first is None:
            return f"the effects of {_names(compound)} contradict each other"
        _, actions, body = first
        return f"impossible {_names(actions)} if {self._text(body)}".removesuffix(" if ")

    def visible(self, state: int, robot: str) -> tuple[str, ...]:
        """The literals that the robot sees in the state, in the order of the fluents."""
        literals = self._vocabulary.complete(state)
        seen = _fired(self._sees.get(robot, ()), literals)
        return self._vocabulary.render(literals & (seen | self._vocabulary.complement(seen)))

    def _compute(self, state: int, compound: frozenset[str]) -> tuple[int, ...]:
        literals = self._vocabulary.complete(state)
        effects = 0
        for action in sorted(compound):
            effects |= _fired(self._rules(action), literals)
        if any(self._forbidding(literals, compound)):
            return ()
        models = self._closure.models(effects, literals & self._inertial | self._closed_world)
        return tuple(sorted(map(self._true, models)))

    def _rules(self, action: str) -> list[Rule]:
        try:
            return self._effects[action]
        except KeyError:
            name = self.description.name
            raise UnknownActionError(f"{action} is not an action of the domain {name}") from None

    def _forbidding(self, literals: int, compound: frozenset[str]) -> Iterator[_Condition]:
        """The laws that make the compound action impossible."""
        for action in compound:
            for number, actions, body in self._impossible.get(action, ()):
                if body & literals == body and actions <= compound:
                    yield number, actions, body


def _fired(rules: Iterable[Rule], literals: int) -> int:
    """The heads of the rules whose body is among the literals."""
    heads = 0
    for rule in rules:
        if rule.body & literals == rule.body:
            heads |= rule.head
    return heads


def _names(actions: Iterable[str]) -> str:
    return ", ".join(sorted(actions))
