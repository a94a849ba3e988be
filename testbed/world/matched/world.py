"""The transition function of a domain whose laws have too many instances to write them down.

The states, successors and refusals are those of `testbed.world.compiled.world.World`, found by
matching each law against the atoms that are true.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from functools import lru_cache
from itertools import product
from typing import Self

from asp.language import Signature, analyse, syntax
from testbed.world.errors import NotExecutableError, UnknownActionError
from testbed.world.matched.change import Change
from testbed.world.matched.facts import (
    GroundAtom,
    GroundLiteral,
    atom_of_text,
    text_of_atom,
)
from testbed.world.matched.laws import Instance, Prohibition
from testbed.world.matched.states import SparseStates

_REMEMBERED = 4096


class SparseWorld(SparseStates):
    """The states of a description, its transitions, and what a robot sees of a state.

    A state is an integer: bit i is set where the i-th fluent is true. Everything is a pure function
    of the state; what was asked last is remembered.
    """

    def __init__(self, source: syntax.Source, signature: Signature, name: str = "") -> None:
        super().__init__(source, signature, name)
        self.agent_actions: tuple[str, ...] = self.description.agent_actions
        self.exogenous_actions: tuple[str, ...] = self.description.exogenous_actions
        self._actions = frozenset((*self.agent_actions, *self.exogenous_actions))
        self._remembered = lru_cache(_REMEMBERED)(self._compute)
        self._made_of = (source, signature, name)

    def __reduce__(self) -> tuple[type[Self], tuple[object, ...]]:
        """A copy is compiled anew: compiled laws cannot be pickled."""
        return type(self), self._made_of

    @classmethod
    def of_text(cls, text: str, file: str = "<text>") -> SparseWorld:
        """The world of an AL_d text. Raises SourceError."""
        return cls(*analyse(text, file))

    def successors(self, state: int, actions: Iterable[str]) -> tuple[int, ...]:
        """Every state the compound action can lead to, sorted; none: it cannot be executed.

        Raises UnknownActionError. The empty compound action is one, too.
        """
        return self._remembered(state, frozenset(actions))

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
        law = self._forbidding(state, self._read(compound))
        return law or f"the effects of {_names(compound)} contradict each other"

    def visible(self, state: int, robot: str) -> tuple[str, ...]:
        """The literals that the robot sees in the state, in the order of the fluents."""
        seen: set[GroundAtom] = set()

        def see(instance: Instance) -> bool:
            seen.add(instance.head[0])
            return False

        facts = self.facts(state)
        for pattern in self._laws.sights:
            pattern.search([("", robot)], facts, see)
        return self._render((atom, facts.may_hold(atom)) for atom in seen)

    def _compute(self, state: int, compound: frozenset[str]) -> tuple[int, ...]:
        actions = self._read(compound)
        if self._forbidding(state, actions) is not None:
            return ()
        facts = self.facts(state)
        effects = self._effects(state, actions)
        change = Change(self._laws, self._defined, facts, effects)
        return tuple(sorted(self._changed(state, outcome) for outcome in change.outcomes()))

    def _read(self, compound: frozenset[str]) -> list[GroundAtom]:
        unknown = sorted(compound - self._actions)
        if unknown:
            name = self.description.name
            raise UnknownActionError(f"{unknown[0]} is not an action of the domain {name}")
        return [atom_of_text(action) for action in sorted(compound)]

    def _effects(self, state: int, actions: list[GroundAtom]) -> list[GroundLiteral]:
        """The direct effects of the actions, each once."""
        effects: dict[GroundLiteral, None] = {}

        def take(instance: Instance) -> bool:
            effects[instance.head] = None
            return False

        for action in actions:
            for pattern in self._laws.effects.get(action[0], ()):
                pattern.search([action], self.facts(state), take)
        return list(effects)

    def _forbidding(self, state: int, actions: list[GroundAtom]) -> str | None:
        """A law that makes the compound action impossible, as text."""
        by_name: dict[str, list[GroundAtom]] = {}
        for action in actions:
            by_name.setdefault(action[0], []).append(action)
        for law in self._laws.prohibitions:
            text = self._applied(law, state, by_name)
            if text is not None:
                return text
        return None

    def _applied(
        self, law: Prohibition, state: int, by_name: Mapping[str, list[GroundAtom]]
    ) -> str | None:
        if not all(name in by_name for name in law.names):
            return None
        facts = self.facts(state)
        reasons: list[Instance] = []

        def first(instance: Instance) -> bool:
            reasons.append(instance)
            return True

        for given in product(*(by_name[name] for name in law.names)):
            if law.pattern.search(given, facts, first):
                actions = _names(map(text_of_atom, given))
                return f"impossible {actions} if {self._text(reasons[0].body)}".removesuffix(" if ")
        return None


def _names(actions: Iterable[str]) -> str:
    return ", ".join(sorted(actions))
