"""What laws say of single actions and tests; those of D_f instance by instance, when asked for."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Iterator, Mapping
from itertools import product

from asp.language import (
    Signature,
    arguments,
    atom,
    complement,
    ground,
    name,
    syntax,
    variable_domains,
)
from asp.language import variable_sorts as roles
from asp.refinement import TRUE, Refinement, true_statics

_TEST, _CAN_TEST = "test_", "can_test_"

Binding = Mapping[str, str]
Domains = Mapping[str, Mapping[str, None]]
"""The constants over which each variable of a law ranges, in their order."""


class Effects:
    """The direct effects of concrete actions and of events."""

    def __init__(self, refinement: Refinement) -> None:
        self._laws: dict[str, list[tuple[syntax.CausalLaw, Domains]]] = {}
        self._signature = refinement.weak_signature
        for law in refinement.weak.each(syntax.CausalLaw):
            domains = _domains(law, self._signature)
            self._laws.setdefault(law.action.name, []).append((law, domains))

    def of(self, action: str, true: Collection[str]) -> tuple[str, ...]:
        """The literals that the action brings about where these fluents are known to be true."""
        found: dict[str, None] = {}
        for law, domains in self._laws.get(name(action), []):
            binding = _bound(law.action, action, {}, domains)
            if binding is not None and _is_met(law.body, binding, true, self._signature):
                effect = _instance(law.head.atom, binding)
                found[effect if law.head.positive else complement(effect)] = None
        return tuple(found)


class Tests:
    """The tests of one robot: of which fluents there are some, and when they are possible."""

    def __init__(self, refinement: Refinement, robot: str) -> None:
        self._robot = robot
        self._signature = refinement.strong_signature
        self._tests = {
            _fluent(law).name: (law, _domains(law, self._signature))
            for law in refinement.strong.each(syntax.CausalLaw)
            if law.action.name.startswith(_TEST) and law.head.atom.args[-1].name == TRUE
        }
        abilities = (
            law
            for law in refinement.strong.each(syntax.StateConstraint)
            if law.head.atom.name.startswith(_CAN_TEST)
        )
        self._abilities = [
            (law, _domains(law, self._signature), self._tests[_tested(law)][0]) for law in abilities
        ]
        self._statics = _statics((law.body for law, _, _ in self._abilities), refinement)

    def of(self, fluent: str) -> str | None:
        """The test of a fluent; None where there is none."""
        if name(fluent) not in self._tests:
            return None
        law, domains = self._tests[name(fluent)]
        robot = {law.action.args[0].name: self._robot}
        binding = _bound(_fluent(law), atom(fluent), robot, domains)
        return None if binding is None else _instance(law.action, binding)

    def is_possible(self, fluent: str, true: Collection[str]) -> bool:
        """Whether a fluent can be tested where fluents are known to be true."""
        test = self.of(fluent)
        if test is None:
            return False
        needed = ground(f"{_CAN_TEST}{name(fluent)}", arguments(test))
        true = self._statics.union(true)
        bound = ((law, _bound(law.head.atom, needed, {}, d), d) for law, d, _ in self._abilities)
        return any(
            True
            for law, given, domains in bound
            if given is not None
            for _ in _matches(law.body, given, domains, true, self._signature)
        )

    def possible(self, true: Collection[str], things: Collection[str]) -> Iterator[str]:
        """The fluents about these things that can be tested where fluents are known to be true.

        What is about the robot itself is left out: that it knows by its own actions.
        """
        true = self._statics.union(true)
        for ability, domains, test in self._abilities:
            for can_test in self._instances(ability, domains, true, things):
                names = [term.name for term in test.action.args]
                fluent = _instance(
                    _fluent(test), dict(zip(names, arguments(can_test), strict=True))
                )
                if self._robot not in arguments(fluent):
                    yield fluent

    def _instances(
        self,
        law: syntax.StateConstraint,
        domains: Domains,
        true: Collection[str],
        things: Collection[str],
    ) -> Iterator[str]:
        """The instances of what a law says can be tested; what nothing binds is a thing."""
        robot = law.head.atom.args[0]
        given = {robot.name: self._robot} if robot.is_variable else {}
        for binding in _matches(law.body, given, domains, true, self._signature):
            free = [variable for variable in domains if variable not in binding]
            choices = ([m for m in domains[v] if m in things] for v in free)
            for values in product(*choices):
                yield _instance(law.head.atom, {**binding, **dict(zip(free, values, strict=True))})


def conditions(refinement: Refinement) -> Mapping[str, frozenset[str]]:
    """The fluents on which it depends whether a coarse action is possible."""
    found: dict[str, frozenset[str]] = {}
    for law in refinement.description.executability:
        for action in law.actions:
            found[action] = found.get(action, frozenset()).union(map(atom, law.body))
    return found


def carriers(refinement: Refinement) -> frozenset[str]:
    """The inertial fluents without counterparts in constraints on fluents that have one."""
    fine = frozenset(refinement.counterparts.values())
    named = {
        literal.atom.name
        for law in refinement.weak.each(syntax.StateConstraint)
        if law.head.atom.name in fine
        for literal in roles.literals(law.body)
    }
    return frozenset(f for f in refinement.description.inertial if name(f) in named)


def direct_effects(refinement: Refinement) -> Mapping[str, frozenset[str]]:
    """What causal laws say that a coarse action may bring about."""
    found: dict[str, frozenset[str]] = {}
    for law in refinement.description.causal:
        found[law.action] = found.get(law.action, frozenset()) | {law.head}
    return found


def _domains(law: syntax.Statement, signature: Signature) -> Domains:
    found = variable_domains(law, signature)
    return {variable: dict.fromkeys(members) for variable, members in found.items()}


def _statics(bodies: Iterable[syntax.Body], refinement: Refinement) -> frozenset[str]:
    """The true statics that bodies of laws of the strong refinement are about."""
    signature = refinement.strong_signature
    named = {literal.atom.name for body in bodies for literal in roles.literals(body)}
    if not any(s.kind == "static" for s in map(signature.symbols.get, named) if s is not None):
        return frozenset()
    return frozenset(s for s in true_statics(refinement.strong, signature) if name(s) in named)


def _tested(law: syntax.StateConstraint) -> str:
    return law.head.atom.name.removeprefix(_CAN_TEST)


def _fluent(law: syntax.CausalLaw) -> syntax.Atom:
    """The fluent that a test is about: the condition under which it is observed to be true."""
    return next(literal.atom for literal in roles.literals(law.body) if literal.positive)


def _matches(
    body: syntax.Body,
    given: Binding,
    domains: Domains,
    true: Collection[str],
    signature: Signature,
) -> Iterator[Binding]:
    """The bindings under which all fluents of a body are among the true ones."""
    fluents = [
        part.atom
        for part in roles.literals(body)
        if part.atom.name in signature.symbols and part.positive
    ]
    bindings: list[Binding] = [given]
    for fluent in fluents:
        bindings = [
            found
            for binding in bindings
            for instance in true
            if (found := _bound(fluent, instance, binding, domains)) is not None
        ]
    return (binding for binding in bindings if _is_met(body, binding, true, signature))


def _is_met(
    body: syntax.Body, binding: Binding, true: Collection[str], signature: Signature
) -> bool:
    """Whether what a body says of bound variables is known to be so; negatives are believed."""
    return all(
        (_instance(part.atom, binding) in true) == part.positive
        for part in roles.literals(body)
        if part.atom.name in signature.symbols
    ) and all(
        (binding.get(c.left.name, c.left.name) == binding.get(c.right.name, c.right.name))
        == c.equal
        for c in roles.comparisons(body)
    )


def _bound(
    pattern: syntax.Atom, instance: str, given: Binding, domains: Domains
) -> dict[str, str] | None:
    """The binding that makes a pattern the instance, beyond what is given; None: there is none."""
    if name(instance) != pattern.name:
        return None
    binding = dict(given)
    for term, value in zip(pattern.args, arguments(instance), strict=True):
        if value != (binding.setdefault(term.name, value) if term.is_variable else term.name):
            return None
        if term.is_variable and value not in domains[term.name]:
            return None
    return binding


def _instance(pattern: syntax.Atom, binding: Binding) -> str:
    return ground(pattern.name, (binding.get(term.name, term.name) for term in pattern.args))
