"""What is made once of a refinement: its planner, its inferences, and what its laws say.

Laws of D_f are read instance by instance, when asked for.
"""

from __future__ import annotations

from collections.abc import Collection, Iterator, Mapping
from itertools import product
from typing import Generic, TypeVar

from asp.language import (
    Signature,
    arguments,
    atom,
    complement,
    functions,
    ground,
    name,
    subject,
    syntax,
    variable_domains,
)
from asp.language import variable_sorts as roles
from asp.reasoning.fine_knowledge import IncrementalFineKnowledge
from asp.reasoning.fine_planning import fine_planner
from asp.refinement import TRUE, Refinement, shared_places
from asp.solving import Recent, preparation

MOST_REFINEMENTS = 16
"""Of how many refinements this is kept: those that were used last."""

_TEST, _CAN_TEST = "test_", "can_test_"

Binding = Mapping[str, str]
S = TypeVar("S", bound=syntax.CausalLaw | syntax.StateConstraint)


class _Law(Generic[S]):
    """A law of D_f, with the constants over which each of its variables ranges, in their order."""

    def __init__(self, law: S, signature: Signature) -> None:
        self.law = law
        domains = variable_domains(law, signature)
        self.domains = {variable: dict.fromkeys(members) for variable, members in domains.items()}
        literals = roles.literals(law.body)
        self._fluents = [part for part in literals if part.atom.name in signature.symbols]

    def bound(
        self, pattern: syntax.Atom, instance: str, given: Binding | None = None
    ) -> dict[str, str] | None:
        """The binding, beyond what is given, that makes a pattern the instance; None: none does."""
        if name(instance) != pattern.name:
            return None
        binding = dict(given or {})
        for term, value in zip(pattern.args, arguments(instance), strict=True):
            if value != (binding.setdefault(term.name, value) if term.is_variable else term.name):
                return None
            if term.is_variable and value not in self.domains[term.name]:
                return None
        return binding

    def matches(self, given: Binding, true: Collection[str]) -> Iterator[Binding]:
        """The bindings under which all fluents of the body are among the true ones."""
        bindings = [given]
        for part in self._fluents:
            if part.positive:
                bindings = [
                    found
                    for binding in bindings
                    for instance in true
                    if (found := self.bound(part.atom, instance, binding)) is not None
                ]
        return (binding for binding in bindings if self.is_met(binding, true))

    def is_met(self, binding: Binding, true: Collection[str]) -> bool:
        """Whether what the body says of bound variables is known; negatives are believed."""
        return all(
            (_instance(part.atom, binding) in true) == part.positive for part in self._fluents
        ) and all(
            (binding.get(c.left.name, c.left.name) == binding.get(c.right.name, c.right.name))
            == c.equal
            for c in roles.comparisons(self.law.body)
        )


class Effects:
    """The direct effects of concrete actions and of events."""

    def __init__(self, refinement: Refinement) -> None:
        self._laws: dict[str, list[_Law[syntax.CausalLaw]]] = {}
        for law in refinement.weak.each(syntax.CausalLaw):
            own = _Law(law, refinement.weak_signature)
            self._laws.setdefault(law.action.name, []).append(own)

    def of(self, action: str, true: Collection[str]) -> tuple[str, ...]:
        """The literals that the action brings about where these fluents are known to be true."""
        found: dict[str, None] = {}
        for own in self._laws.get(name(action), []):
            binding = own.bound(own.law.action, action)
            if binding is not None and own.is_met(binding, true):
                effect = _instance(own.law.head.atom, binding)
                found[effect if own.law.head.positive else complement(effect)] = None
        return tuple(found)


class Tests:
    """The tests of one robot: of which fluents there are some, and when they are possible."""

    def __init__(self, refinement: Refinement, robot: str) -> None:
        self._robot = robot
        signature = refinement.strong_signature
        self._tests = {
            _fluent(law).name: _Law(law, signature)
            for law in refinement.strong.each(syntax.CausalLaw)
            if law.action.name.startswith(_TEST) and law.head.atom.args[-1].name == TRUE
        }
        self._abilities = [
            _Law(law, signature)
            for law in refinement.strong.each(syntax.StateConstraint)
            if law.head.atom.name.startswith(_CAN_TEST)
        ]
        named = {part.atom.name for own in self._abilities for part in roles.literals(own.law.body)}
        self._statics = frozenset(static for static in refinement.statics if static.name in named)

    def of(self, fluent: str) -> str | None:
        """The test of a fluent; None where there is none."""
        if name(fluent) not in self._tests:
            return None
        own = self._tests[name(fluent)]
        robot = {own.law.action.args[0].name: self._robot}
        binding = own.bound(_fluent(own.law), atom(fluent), robot)
        return None if binding is None else _instance(own.law.action, binding)

    def is_possible(self, fluent: str, true: Collection[str]) -> bool:
        """Whether a fluent can be tested where fluents are known to be true."""
        test = self.of(fluent)
        if test is None:
            return False
        needed = ground(f"{_CAN_TEST}{name(fluent)}", arguments(test))
        true = self._statics.union(true)
        bound = ((own, own.bound(own.law.head.atom, needed)) for own in self._abilities)
        return any(
            True for own, given in bound if given is not None for _ in own.matches(given, true)
        )

    def possible(self, true: Collection[str], things: Collection[str]) -> Iterator[str]:
        """The fluents about these things that can be tested where fluents are known to be true.

        What is about the robot itself is left out: that it knows by its own actions.
        """
        true = self._statics.union(true)
        for ability in self._abilities:
            test = self._tests[ability.law.head.atom.name.removeprefix(_CAN_TEST)].law
            names = [term.name for term in test.action.args]
            for can_test in self._instances(ability, true, things):
                binding = dict(zip(names, arguments(can_test), strict=True))
                fluent = _instance(_fluent(test), binding)
                if self._robot not in arguments(fluent):
                    yield fluent

    def _instances(
        self, own: _Law[syntax.StateConstraint], true: Collection[str], things: Collection[str]
    ) -> Iterator[str]:
        """The instances of what a law says can be tested; what nothing binds is a thing."""
        robot = own.law.head.atom.args[0]
        given = {robot.name: self._robot} if robot.is_variable else {}
        for binding in own.matches(given, true):
            free = [variable for variable in own.domains if variable not in binding]
            choices = ([m for m in own.domains[v] if m in things] for v in free)
            for values in product(*choices):
                whole = {**binding, **dict(zip(free, values, strict=True))}
                yield _instance(own.law.head.atom, whole)


def _fluent(law: syntax.CausalLaw) -> syntax.Atom:
    """The fluent that a test is about: the condition under which it is observed to be true."""
    return next(literal.atom for literal in roles.literals(law.body) if literal.positive)


def _instance(pattern: syntax.Atom, binding: Binding) -> str:
    return ground(pattern.name, (binding.get(term.name, term.name) for term in pattern.args))


class FineModel:
    """Planner, inferences and laws of one refinement.

    `shares_places` says whether the components of anything are always in the same place;
    `unmagnified` are the inertial fluents without counterparts, and `carriers` those of them that
    constraints on fine fluents depend on. Of each coarse action, `conditions` are the fluents on
    which it depends whether it is possible, and `direct_effects` what causal laws say that it may
    bring about.
    """

    def __init__(self, refinement: Refinement) -> None:
        weak, magnified = refinement.weak, refinement.counterparts
        self.planner = fine_planner(weak, refinement.weak_signature)
        self.knowledge = IncrementalFineKnowledge(refinement)
        self.effects = Effects(refinement)
        self.shares_places = bool(shared_places(weak))
        self.unmagnified = frozenset(
            fluent for fluent in refinement.description.inertial if name(fluent) not in magnified
        )
        fine = frozenset(magnified.values())
        named = {
            literal.atom.name
            for law in weak.each(syntax.StateConstraint)
            if law.head.atom.name in fine
            for literal in roles.literals(law.body)
        }
        self.carriers = frozenset(fluent for fluent in self.unmagnified if name(fluent) in named)
        self.conditions: dict[str, frozenset[str]] = {}
        for law in refinement.description.executability:
            for action in law.actions:
                before = self.conditions.get(action, frozenset())
                self.conditions[action] = before.union(map(atom, law.body))
        self.direct_effects: dict[str, frozenset[str]] = {}
        for causal in refinement.description.causal:
            found = self.direct_effects.get(causal.action, frozenset())
            self.direct_effects[causal.action] = found | {causal.head}
        self._functions = functions(weak, refinement.weak_signature)
        self._refinement = refinement
        self._tests: dict[str, Tests] = {}

    def tests(self, robot: str) -> Tests:
        """The tests of a robot."""
        if robot not in self._tests:
            with preparation():
                self._tests[robot] = Tests(self._refinement, robot)
        return self._tests[robot]

    def is_value(self, fluent: str) -> bool:
        """Whether a fine fluent is one of several of which one always holds."""
        return subject(fluent, self._functions) is not None


_MODELS: Recent[Refinement, FineModel] = Recent(MOST_REFINEMENTS)


def fine_model(refinement: Refinement) -> FineModel:
    """The model of a refinement, made when it is first asked for, as preparation."""
    with preparation():
        return _MODELS.get(refinement, lambda: FineModel(refinement))
