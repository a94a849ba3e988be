"""What is made once of a refinement: its planner, its inferences, and what its laws say.

Laws of D_f are read instance by instance, when asked for.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Collection, Iterable, Iterator
from itertools import chain
from typing import NamedTuple

from asp.language import (
    NOTHING,
    Facts,
    Literal,
    Pattern,
    closed_world,
    functions,
    pattern_of,
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


class Effects:
    """The direct effects of concrete actions and of events."""

    def __init__(self, refinement: Refinement, statics: Facts) -> None:
        self._laws: dict[str, list[Pattern]] = defaultdict(list)
        for law in refinement.weak.each(syntax.CausalLaw):
            given, signature = law.action.args, refinement.weak_signature
            pattern = pattern_of(law, signature, statics, given, law.head)
            self._laws[law.action.name].append(pattern)

    def of(self, action: str, true: Iterable[str]) -> tuple[Literal, ...]:
        """The literals that the action brings about where these fluents are known to be true."""
        one, facts = Literal.parse(action), Facts(map(Literal.parse, true))
        heads = (law.heads(one.arguments, facts) for law in self._laws.get(one.name, ()))
        return tuple(dict.fromkeys(chain.from_iterable(heads)))


class _Ability(NamedTuple):
    """When a fluent can be tested, by one law, of whose variables nothing binds the `free` ones."""

    fluent: str
    head: syntax.Atom
    of_robot: Pattern
    of_test: Pattern
    free: set[str]


class Tests:
    """The tests of one robot: of which fluents there are some, and when they are possible."""

    def __init__(self, refinement: Refinement, robot: str, statics: Facts) -> None:
        signature = refinement.strong_signature
        self._robot = robot
        constants = dict.fromkeys(m for members in signature.sorts.values() for m in members)
        self._rank = {constant: rank for rank, constant in enumerate(constants)}
        self._tests: dict[str, Pattern] = {}
        self._fluents: dict[str, Pattern] = {}
        for law in refinement.strong.each(syntax.CausalLaw):
            if law.action.name.startswith(_TEST) and law.head.atom.args[-1].name == TRUE:
                test, domains = law.action, variable_domains(law, signature)
                fluent = next(each for each in roles.literals(law.body) if each.positive)
                given, name = (test.args[0], *fluent.atom.args), fluent.atom.name
                head = syntax.Literal(test, True)
                self._tests[name] = Pattern(domains, (), NOTHING, given, head)
                self._fluents[name] = Pattern(domains, (), NOTHING, test.args, fluent)
        self._abilities: list[_Ability] = []
        for ability in refinement.strong.each(syntax.StateConstraint):
            head = ability.head
            name = head.atom.name.removeprefix(_CAN_TEST)
            if name != head.atom.name:
                args, parts = head.atom.args, roles.literals(ability.body)
                bound = {term.name for part in parts if part.positive for term in part.atom.args}
                free = {term.name for term in args[1:]} - bound
                of_robot = pattern_of(ability, signature, statics, args[:1], head)
                of_test = pattern_of(ability, signature, statics, args, head)
                self._abilities.append(_Ability(name, head.atom, of_robot, of_test, free))

    def of(self, fluent: str) -> Literal | None:
        """The test of a fluent; None where there is none."""
        atom = Literal.parse(fluent).atom
        if atom.name not in self._tests:
            return None
        return next(self._tests[atom.name].heads((self._robot, *atom.arguments), NOTHING), None)

    def is_possible(self, fluent: str, true: Iterable[str]) -> bool:
        """Whether a fluent can be tested where fluents are known to be true."""
        test, facts = self.of(fluent), Facts(map(Literal.parse, true))
        name = Literal.parse(fluent).name
        return test is not None and any(
            True
            for ability in self._abilities
            if ability.fluent == name
            for _ in ability.of_test.matches(test.arguments, facts)
        )

    def possible(self, true: Iterable[str], things: Collection[str]) -> Iterator[Literal]:
        """The fluents about these things that can be tested where fluents are known to be true.

        What is about the robot itself is left out: that it knows by its own actions.
        """
        facts = Facts(map(Literal.parse, true))
        for ability in self._abilities:
            rows = [
                tuple(values[term.name] for term in ability.head.args)
                for values in ability.of_robot.matches((self._robot,), facts)
                if all(values[variable] in things for variable in ability.free)
            ]
            for row in sorted(rows, key=lambda row: [self._rank[each] for each in row]):
                fluent = next(self._fluents[ability.fluent].heads(row, NOTHING))
                if self._robot not in fluent.arguments:
                    yield fluent


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
        self._statics = closed_world(refinement.statics, refinement.strong_signature)
        self.effects = Effects(refinement, self._statics)
        self.shares_places = bool(shared_places(weak))
        self.unmagnified = frozenset(
            fluent for fluent in refinement.description.inertial if fluent.name not in magnified
        )
        fine = frozenset(magnified.values())
        named = {
            literal.atom.name
            for law in weak.each(syntax.StateConstraint)
            if law.head.atom.name in fine
            for literal in roles.literals(law.body)
        }
        self.carriers = frozenset(fluent for fluent in self.unmagnified if fluent.name in named)
        self.conditions: dict[str, frozenset[str]] = {}
        for law in refinement.description.executability:
            for action in law.actions:
                before = self.conditions.get(action, frozenset())
                self.conditions[action] = before.union(each.atom for each in law.body)
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
                self._tests[robot] = Tests(self._refinement, robot, self._statics)
        return self._tests[robot]

    def is_value(self, fluent: str) -> bool:
        """Whether a fine fluent is one of several of which one always holds."""
        return subject(fluent, self._functions) is not None


_MODELS: Recent[Refinement, FineModel] = Recent(MOST_REFINEMENTS)


def fine_model(refinement: Refinement) -> FineModel:
    """The model of a refinement, made when it is first asked for, as preparation."""
    with preparation():
        return _MODELS.get(refinement, lambda: FineModel(refinement))
