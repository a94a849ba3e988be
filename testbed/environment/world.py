"""The transition function of a domain, compiled from its ground description (P 3.1.1).

A successor is the closure, under the state constraints, of the direct effects and of what inertia
keeps; a compound action without one cannot be executed.
"""

from __future__ import annotations

from collections.abc import Iterable

from asp.description import Description
from testbed.environment.closure import Rule
from testbed.environment.errors import NotExecutableError, UnknownActionError
from testbed.environment.states import StateSpace


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
        self._impossible = tuple(
            (frozenset(law.actions), mask(law.body)) for law in description.executability
        )
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
        law = self._forbidding(self._vocabulary.complete(state), compound)
        return law or f"the effects of {_names(compound)} contradict each other"

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
        if self._forbidding(literals, compound):
            return ()
        models = self._closure.models(effects, literals & self._inertial | self._closed_world)
        return tuple(sorted(map(self._true, models)))

    def _rules(self, action: str) -> list[Rule]:
        try:
            return self._effects[action]
        except KeyError:
            name = self.description.name
            raise UnknownActionError(f"{action} is not an action of the domain {name}") from None

    def _forbidding(self, literals: int, compound: frozenset[str]) -> str | None:
        """The first law that makes the compound action impossible, as text."""
        for actions, body in self._impossible:
            if actions <= compound and body & literals == body:
                return f"impossible {_names(actions)} if {self._text(body)}".removesuffix(" if ")
        return None


def _fired(rules: Iterable[Rule], literals: int) -> int:
    """The heads of the rules whose body is among the literals."""
    heads = 0
    for rule in rules:
        if rule.body & literals == rule.body:
            heads |= rule.head
    return heads


def _names(actions: Iterable[str]) -> str:
    return ", ".join(sorted(actions))
