"""The tests of a strong refinement: what they observe, and when they are possible (P 3.3, 16a-16c).

A test is an action of the theory of observation: a causal law says which fluent it observes, and
constraints on `can_test_...` say when it is possible.
"""

from collections import defaultdict
from collections.abc import Collection, Iterable, Iterator
from functools import cached_property, lru_cache
from typing import NamedTuple

from asp.language import (
    NOTHING,
    Action,
    Facts,
    Fluent,
    Literal,
    Pattern,
    Truth,
    closed_world,
    pattern_of,
    reachable,
    syntax,
    variable_domains,
)
from asp.language import variable_sorts as roles
from asp.refinement.observation import CAN_TEST, TEST
from asp.refinement.refinement import Refinement

_REFINEMENTS = 16


class _Ability(NamedTuple):
    """When a fluent can be tested, by one law, of whose variables nothing binds the `free` ones."""

    head: syntax.Atom
    of_robot: Pattern
    of_test: Pattern
    free: set[str]


class Sensing:
    """The tests of a refinement; `names` are those of the actions."""

    def __init__(self, refinement: Refinement) -> None:
        self._refinement = refinement
        signature = refinement.strong_signature
        constants = dict.fromkeys(m for members in signature.sorts.values() for m in members)
        self._rank = {constant: rank for rank, constant in enumerate(constants)}
        self._fluents: dict[str, Pattern] = {}
        self._tests: dict[str, Pattern] = {}
        for law in refinement.strong.each(syntax.CausalLaw):
            test, domains = law.action, variable_domains(law, signature)
            is_test = test.name not in refinement.weak_signature.symbols
            for fluent in roles.literals(law.body if is_test else ()):
                if fluent.positive:
                    given, head = (test.args[0], *fluent.atom.args), syntax.Literal(test, True)
                    self._fluents[test.name] = Pattern(domains, (), NOTHING, test.args, fluent)
                    self._tests[fluent.atom.name] = Pattern(domains, (), NOTHING, given, head)
        self.names = frozenset(self._fluents)
        self.fluent = lru_cache(4096)(self._fluent)
        self._abilities: dict[str, list[_Ability]] = defaultdict(list)
        self._definitions: list[Pattern] = []
        self._read_constraints()

    def _read_constraints(self) -> None:
        """When fluents can be tested, and what defines fluents on which that depends."""
        signature = self._refinement.strong_signature
        statics = closed_world(self._refinement.statics, signature)
        defining: dict[str, list[syntax.StateConstraint]] = defaultdict(list)
        needs: dict[str, set[str]] = defaultdict(set)
        for law in self._refinement.strong.each(syntax.StateConstraint):
            head, body = law.head.atom, list(roles.literals(law.body))
            name, args = head.name, head.args
            if signature.symbols[name].kind == "defined":
                needs[name].update(part.atom.name for part in body)
                defining[name].append(law)
            if name.startswith(CAN_TEST):
                bound = {term.name for part in body if part.positive for term in part.atom.args}
                free = {term.name for term in args[1:]} - bound
                of_robot = pattern_of(law, signature, statics, args[:1], law.head)
                of_test = pattern_of(law, signature, statics, args, law.head)
                ability = _Ability(head, of_robot, of_test, free)
                self._abilities[name.removeprefix(CAN_TEST)].append(ability)
        tested = {CAN_TEST + fluent for fluent in self._abilities}
        for name in {needed for each in tested for needed in reachable(each, needs)} - tested:
            for law in defining.get(name, ()):
                self._definitions.append(pattern_of(law, signature, statics, head=law.head))

    def __reduce__(self) -> tuple[object, ...]:
        """A copy is compiled anew: compiled laws cannot be pickled."""
        return sensing_of, (self._refinement,)

    @cached_property
    def actions(self) -> tuple[Action, ...]:
        """All tests."""
        every = self._refinement.strong_signature.atoms("agent")
        return tuple(action for action in every if action.name in self.names)

    def _fluent(self, action: str) -> Fluent:
        """The fluent that a test observes."""
        test = Literal.parse(action)
        return next(self._fluents[test.name].heads(test.arguments, NOTHING))

    def test_of(self, robot: str, fluent: str) -> Action | None:
        """The robot's test of a fluent; None where there is none."""
        atom = Literal.parse(fluent).atom
        if atom.name not in self._tests:
            return None
        return next(self._tests[atom.name].heads((robot, *atom.arguments), NOTHING), None)

    def can(self, action: str, truth: Truth) -> bool:
        """Whether the test is possible where this is true."""
        test = Literal.parse(action)
        abilities = self._abilities.get(test.name.removeprefix(TEST), ())
        return any(True for own in abilities for _ in own.of_test.matches(test.arguments, truth))

    def facts(self, true: Iterable[str]) -> Facts:
        """These fluents as facts, with the defined ones that tests depend on and that follow."""
        known = frozenset(map(Literal.parse, true))
        while True:
            facts = Facts(known)
            derived = known.union(*(law.heads((), facts) for law in self._definitions))
            if derived == known:
                return facts
            known = derived

    def possible(self, robot: str, truth: Truth, things: Collection[str]) -> Iterator[Fluent]:
        """The fluents about these things that the robot can test where this is true.

        What is about the robot itself is left out: that it knows by its own actions.
        """
        for name, abilities in self._abilities.items():
            for ability in abilities:
                rows = [
                    tuple(values[term.name] for term in ability.head.args)
                    for values in ability.of_robot.matches((robot,), truth)
                    if all(values[variable] in things for variable in ability.free)
                ]
                for row in sorted(rows, key=lambda row: [self._rank[each] for each in row]):
                    fluent = next(self._fluents[TEST + name].heads(row, NOTHING))
                    if robot not in fluent.arguments:
                        yield fluent


@lru_cache(_REFINEMENTS)
def sensing_of(refinement: Refinement) -> Sensing:
    """The tests of a refinement's theory of observation; made once."""
    return Sensing(refinement)
