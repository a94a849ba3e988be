"""A world whose laws are matched against what is true, and never instantiated as a whole."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import replace
from functools import lru_cache
from itertools import product
from pathlib import Path

from asp.language import Description, Literal, Signature, ground_description, syntax
from testbed.world.compiled import CompiledWorld
from testbed.world.matched.change import Change
from testbed.world.matched.facts import (
    Facts,
    GroundAtom,
    GroundLiteral,
    atom_of,
    literal_of,
)
from testbed.world.matched.laws import Instance, Laws, Prohibition
from testbed.world.world import Law, World, bits

_SUCCESSORS, _STATES = 4096, 256


class MatchedWorld(World):
    """The backend for descriptions whose laws have too many instances to write them down."""

    def __init__(self, source: syntax.Source, signature: Signature) -> None:
        super().__init__(_declared(source, signature), remembered=_SUCCESSORS)
        self._arguments = (source, signature)
        self._atoms = tuple(map(atom_of, self.fluents))
        self._bits = {atom: 1 << number for number, atom in enumerate(self._atoms)}
        self._defined = frozenset(fluent.name for fluent in self.description.defined)
        self.signature = signature
        self.statics = Facts(map(atom_of, self.description.statics))
        self._laws = Laws(source, signature, self.statics)
        self.facts = lru_cache(_STATES)(self._decode)
        self._described = lru_cache(1)(self._describe)

    def is_state(self, state: int) -> bool:
        facts = self.facts(state)

        def broken(instance: Instance) -> bool:
            atom, positive = instance.head
            return facts.may_hold(atom) != positive

        laws = self._laws.constraints
        return not any(p.search([], facts, broken) for p in laws) and self._founded(facts)

    def _founded(self, facts: Facts) -> bool:
        """Whether each true defined fluent is derived, in the end from none of its kind."""
        true = {atom for name in self._defined for atom in facts.named(name)}
        bodies: list[tuple[GroundAtom, list[GroundAtom]]] = []

        def keep(instance: Instance) -> bool:
            needs = [atom for atom, positive in instance.body if positive and atom in true]
            bodies.append((instance.head[0], needs))
            return False

        for atom in true:
            for pattern in self._laws.supports.get((atom[0], True), ()):
                pattern.search([atom], facts, keep)
        derived: set[GroundAtom] = set()
        grew = True
        while grew:
            more = {head for head, needs in bodies if derived.issuperset(needs)} - derived
            grew = bool(more)
            derived |= more
        return derived == true

    def states(self) -> Iterator[int]:
        """By way of the instances of the laws: where the states can be listed these can, too."""
        source, signature = self._arguments
        ground = ground_description(source, signature, self.description.name)
        return CompiledWorld(ground).states()

    def adjusted(self, state: int, literals: Iterable[str]) -> tuple[int, ...]:
        return self._changed(state, self._read(literals))

    def _completions(self, literals: tuple[str, ...]) -> Iterable[int]:
        return self._outcomes(0, self._described(literals))

    def _broken(self, literals: tuple[str, ...]) -> Law | None:
        law = self._described(literals).conflict()
        return None if law is None else ((literal_of(law.head),), _literals(law.body))

    def _describe(self, literals: tuple[str, ...]) -> Change:
        """What the literals make of a state in which nothing is true."""
        seeds: list[GroundLiteral] = []

        def keep(instance: Instance) -> bool:
            seeds.append(instance.head)
            return False

        for pattern in self._laws.groundless:
            pattern.search([], self.facts(0), keep)
        return Change(self._laws, self._defined, self.facts(0), self._read(literals), seeds)

    def _transitions(self, state: int, compound: frozenset[str]) -> tuple[int, ...]:
        if self._forbidding(state, compound) is not None:
            return ()
        effects: dict[GroundLiteral, None] = {}

        def take(instance: Instance) -> bool:
            effects[instance.head] = None
            return False

        for action in map(atom_of, sorted(compound)):
            for pattern in self._laws.effects.get(action[0], ()):
                pattern.search([action], self.facts(state), take)
        return self._changed(state, effects)

    def _changed(self, state: int, literals: Iterable[GroundLiteral]) -> tuple[int, ...]:
        change = Change(self._laws, self._defined, self.facts(state), literals)
        return self._outcomes(state, change)

    def _outcomes(self, state: int, change: Change) -> tuple[int, ...]:
        """The state with the values that the change gives to its atoms, outcome by outcome."""
        found = []
        for values in change.outcomes():
            true = sum(self._bits[atom] for atom, holds in values.items() if holds)
            touched = sum(self._bits[atom] for atom in values)
            found.append(state & ~touched | true)
        return tuple(sorted(found))

    def _forbidding(self, state: int, compound: frozenset[str]) -> Law | None:
        by_name: dict[str, list[GroundAtom]] = {}
        for action in map(atom_of, sorted(compound)):
            by_name.setdefault(action[0], []).append(action)
        found = (self._applied(law, state, by_name) for law in self._laws.prohibitions)
        return next((law for law in found if law is not None), None)

    def _applied(
        self, law: Prohibition, state: int, by_name: Mapping[str, list[GroundAtom]]
    ) -> Law | None:
        reasons: list[Instance] = []

        def first(instance: Instance) -> bool:
            reasons.append(instance)
            return True

        for given in product(*(by_name.get(name, ()) for name in law.names)):
            if law.pattern.search(given, self.facts(state), first):
                actions = ((action, True) for action in given)
                return _literals(actions), _literals(reasons[0].body)
        return None

    def _seen(self, state: int, robot: str) -> int:
        seen: set[GroundAtom] = set()

        def see(instance: Instance) -> bool:
            seen.add(instance.head[0])
            return False

        for pattern in self._laws.sights:
            pattern.search([("", robot)], self.facts(state), see)
        return sum(self._bits[atom] for atom in seen)

    def _read(self, literals: Iterable[str]) -> list[GroundLiteral]:
        """The literals, each once. Raises UnknownFluentError."""
        numbered = dict.fromkeys(map(self._numbered, literals))
        return [(self._atoms[number], positive) for number, positive in numbered]

    def _decode(self, state: int) -> Facts:
        return Facts(self._atoms[number] for number in bits(state))


def _literals(literals: Iterable[GroundLiteral]) -> tuple[Literal, ...]:
    return tuple(map(literal_of, literals))


def _declared(source: syntax.Source, signature: Signature) -> Description:
    """The ground description without the laws about fluents."""
    laws = (syntax.CausalLaw, syntax.ExecutabilityCondition, syntax.TriggerStatement)
    kept = tuple(
        s for s in source.statements if not isinstance(s, laws) and not _about_fluents(s, signature)
    )
    return ground_description(replace(source, statements=kept), signature, Path(source.file).stem)


def _about_fluents(statement: syntax.Statement, signature: Signature) -> bool:
    if not isinstance(statement, syntax.StateConstraint):
        return False
    return signature.symbols[statement.head.atom.name].kind != "static"
