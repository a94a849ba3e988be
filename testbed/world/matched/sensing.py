"""The tests of a strong refinement, played in the world of the weak one (P 3.3, 16a-16c).

A test is an action of the theory of observation: a causal law says which fluent it observes, an
executability condition which fluent `can_test_...` it needs, and constraints when that holds.
"""

from __future__ import annotations

from collections.abc import Iterator
from functools import lru_cache
from itertools import product
from typing import Self

from asp.language import Literal, Signature, ground, syntax
from asp.language import variable_sorts as roles
from testbed.world.matched.facts import Facts, GroundAtom, atom_of, literal_of
from testbed.world.matched.laws import Instance, Pattern, Reader
from testbed.world.matched.world import MatchedWorld


class Sensing:
    """The actions of `strong` that the world does not have; `actions` are their instances."""

    def __init__(self, world: MatchedWorld, strong: syntax.Source, signature: Signature) -> None:
        self._world = world
        self._signature = signature
        physical = world.signature.symbols
        tests = [d for d in signature.symbols.values() if d.kind == "agent"]
        tests = [d for d in tests if d.name not in physical]
        self.names = frozenset(declaration.name for declaration in tests)
        self.actions = tuple(
            ground(d.name, args)
            for d in tests
            for args in product(*(signature.sorts[sort.name] for sort in d.sorts))
        )
        observing = [law for law in strong.each(syntax.CausalLaw) if law.action.name in self.names]
        pairs = [(law.action, lit.atom, law) for law in observing for lit in _observed(law)]
        self._fluents = {test.name: self._map(test, atom, law) for test, atom, law in pairs}
        self._tests = {atom.name: self._map(atom, test, law) for test, atom, law in pairs}
        self._needs: dict[str, Pattern] = {}
        for law in strong.each(syntax.ExecutabilityCondition):
            for test in law.actions:
                if test.name in self.names:
                    needed = next(roles.literals(law.body)).atom
                    self._needs[test.name] = self._map(test, needed, law)
        self._abilities: dict[str, list[Pattern]] = {}
        for constraint in strong.each(syntax.StateConstraint):
            name = constraint.head.atom.name
            self._abilities.setdefault(name, []).append(self._ability(constraint))
        self.fluent = lru_cache(4096)(self._fluent)
        self._made_of = (world, strong, signature)

    def __reduce__(self) -> tuple[type[Self], tuple[object, ...]]:
        """A copy is compiled anew: compiled laws cannot be pickled."""
        return type(self), self._made_of

    def can(self, state: int, action: str) -> bool:
        """Whether the test is possible in the state."""
        test = atom_of(action)
        facts = self._world.facts(state)
        return all(
            any(ability.search([need], facts, _stop) for ability in self._abilities[need[0]])
            for need in _images(self._needs[test[0]], test)
        )

    def _fluent(self, action: str) -> Literal:
        """The fluent that a test observes."""
        test = atom_of(action)
        return literal_of((_images(self._fluents[test[0]], test)[0], True))

    def test_of(self, robot: str, fluent: str) -> Literal | None:
        """The robot's test of a fluent, if there is one."""
        atom = atom_of(fluent)
        if atom[0] not in self._tests:
            return None
        tests = (test for test in _images(self._tests[atom[0]], atom) if test[1] == robot)
        return next((literal_of((test, True)) for test in tests), None)

    def _map(self, one: syntax.Atom, other: syntax.Atom, law: syntax.Statement) -> Pattern:
        """From an atom of a law to another with the same variables."""
        read = Reader(law, self._signature, self._world.statics)
        head = read.membership(syntax.Literal(other, True))
        return Pattern(read.scope, [read.template(one)], head, [], [])

    def _ability(self, law: syntax.StateConstraint) -> Pattern:
        read = Reader(law, self._signature, self._world.statics)
        head, body = read.membership(law.head), read.conditions(law.body)
        return Pattern(read.scope, [head.atom], head, body, body)


def _observed(law: syntax.CausalLaw) -> Iterator[syntax.Literal]:
    """The literal of whose truth a test's law says that it is observed."""
    return (literal for literal in roles.literals(law.body) if literal.positive)


def _images(mapping: Pattern, atom: GroundAtom) -> list[GroundAtom]:
    found: list[GroundAtom] = []

    def keep(instance: Instance) -> bool:
        found.append(instance.head[0])
        return False

    mapping.search([atom], Facts(()), keep)
    return found


def _stop(_instance: Instance) -> bool:
    return True
