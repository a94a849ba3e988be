"""The tests of a strong refinement, played in the world of the weak one (P 3.3, 16a-16c).

A test is an action of the theory of observation: a causal law says which fluent it observes, an
executability condition which fluent `can_test_...` it needs, and constraints when that holds.
"""

from __future__ import annotations

from collections import defaultdict
from functools import lru_cache
from itertools import product
from typing import Self

from asp.language import NOTHING, Literal, Pattern, Signature, pattern_of, syntax, variable_domains
from asp.language import variable_sorts as roles
from testbed.world.matched.world import MatchedWorld


class Sensing:
    """The actions of `strong` that the world does not have; `actions` are their instances."""

    def __init__(self, world: MatchedWorld, strong: syntax.Source, signature: Signature) -> None:
        self._world = world
        tests = [d for d in signature.symbols.values() if d.kind == "agent"]
        tests = [d for d in tests if d.name not in world.signature.symbols]
        self.names = frozenset(declaration.name for declaration in tests)
        self.actions = tuple(
            Literal.of(d.name, args)
            for d in tests
            for args in product(*(signature.sorts[sort.name] for sort in d.sorts))
        )

        def mapping(law: syntax.Statement, one: syntax.Atom, other: syntax.Atom) -> Pattern:
            """From an atom of a law to another with the same variables."""
            domains = variable_domains(law, signature)
            return Pattern(domains, (), NOTHING, one.args, syntax.Literal(other, True))

        self._fluents: dict[str, Pattern] = {}
        self._tests: dict[str, Pattern] = {}
        self._needs: dict[str, Pattern] = {}
        self._abilities: dict[str, list[Pattern]] = defaultdict(list)
        for law in strong.each(syntax.CausalLaw):
            for part in roles.literals(law.body if law.action.name in self.names else ()):
                if part.positive:
                    self._fluents[law.action.name] = mapping(law, law.action, part.atom)
                    self._tests[part.atom.name] = mapping(law, part.atom, law.action)
        for condition in strong.each(syntax.ExecutabilityCondition):
            for test in condition.actions:
                if test.name in self.names:
                    needed = next(roles.literals(condition.body)).atom
                    self._needs[test.name] = mapping(condition, test, needed)
        for constraint in strong.each(syntax.StateConstraint):
            head = constraint.head.atom
            ability = pattern_of(constraint, signature, world.statics, head.args)
            self._abilities[head.name].append(ability)
        self.fluent = lru_cache(4096)(self._fluent)
        self._made_of = (world, strong, signature)

    def __reduce__(self) -> tuple[type[Self], tuple[object, ...]]:
        """A copy is compiled anew: compiled laws cannot be pickled."""
        return type(self), self._made_of

    def can(self, state: int, action: str) -> bool:
        """Whether the test is possible in the state."""
        test, facts = Literal.parse(action), self._world.facts(state)
        return all(
            any(
                True
                for ability in self._abilities[need.name]
                for _ in ability.matches(need.arguments, facts)
            )
            for need in self._needs[test.name].heads(test.arguments, facts)
        )

    def _fluent(self, action: str) -> Literal:
        """The fluent that a test observes."""
        test = Literal.parse(action)
        return next(self._fluents[test.name].heads(test.arguments, NOTHING))

    def test_of(self, robot: str, fluent: str) -> Literal | None:
        """The robot's test of a fluent, if there is one."""
        atom = Literal.parse(fluent)
        if atom.name not in self._tests:
            return None
        tests = self._tests[atom.name].heads(atom.arguments, NOTHING)
        return next((test for test in tests if test.arguments[0] == robot), None)
