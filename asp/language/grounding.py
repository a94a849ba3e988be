"""From a checked source to the ground description: the instances of its statements.

A variable takes the members of its sort, and the statics are those of the closed world.
"""

from collections import defaultdict
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, fields
from itertools import product
from typing import Any, TypeVar

from asp.language import syntax
from asp.language.description import (
    Causal,
    Constraint,
    Default,
    Description,
    Draw,
    Executability,
    Literals,
    Sees,
    Shows,
    Trigger,
)
from asp.language.literals import Fluent, Literal
from asp.language.matching import NOTHING, Facts, Pattern, Row
from asp.language.signature import Signature
from asp.language.variable_sorts import AGENT, FLUENTS, bodies, default_atom, variable_domains

Binding = Mapping[str, str]
G = TypeVar("G", Causal, Constraint, Executability, Sees, Shows, Trigger)


def ground_description(source: syntax.Source, signature: Signature, name: str) -> Description:
    """Instantiates every statement over the members of its variables' sorts."""
    instances = Instances(source, signature, static_truth(source, signature)[0])
    constraints = source.each(syntax.StateConstraint)
    on_fluents = (law for law in constraints if signature.kind(law.head.atom.name) != "static")
    agent_actions = signature.atoms("agent")
    costs: dict[str, int] = dict.fromkeys(agent_actions, 0)
    for statement in source.each(syntax.CostStatement):
        for binding, _ in instances.of(statement):
            costs[instance(statement.action, binding)] = statement.units
    return Description(
        name=name,
        source=source.text,
        sorts=dict(signature.sorts),
        statics=instances.statics,
        inertial=signature.atoms("inertial"),
        defined=signature.atoms("defined"),
        agent_actions=agent_actions,
        exogenous_actions=signature.atoms("exogenous"),
        causal=instances.ground(source.each(syntax.CausalLaw), Causal),
        constraints=instances.ground(on_fluents, Constraint),
        executability=instances.ground(source.each(syntax.ExecutabilityCondition), Executability),
        sees=instances.ground(source.each(syntax.SeesStatement), Sees),
        shows=instances.ground(source.each(syntax.ShowsStatement), Shows),
        costs=costs,
        initially=_initially(instances),
        defaults=_defaults(instances),
        triggers=instances.ground(source.each(syntax.TriggerStatement), Trigger),
        scenarios=source.scenarios,
    )


@dataclass(frozen=True)
class Instances:
    """The instances that statics and comparisons allow; `statics` are those that are true."""

    source: syntax.Source
    signature: Signature
    statics: frozenset[Literal]

    def ground(self, statements: Iterable[syntax.Statement], kind: type[G]) -> tuple[G, ...]:
        """The ground statements of a kind, whose fields are named as those of the statements."""
        names = [field.name for field in fields(kind)]
        return tuple(
            kind(**{n: left[n] if n in left else instance(getattr(own, n), binding) for n in names})
            for own in statements
            for binding, left in self.of(own)
        )

    def of(self, statement: syntax.Statement) -> Iterator[tuple[Binding, dict[str, Any]]]:
        """The bindings that the statics and comparisons allow, with what is left of the bodies."""
        domains = variable_domains(statement, self.signature)
        known = [condition for condition in bodies(statement) if not self._is_open(condition)]
        body = self._open(getattr(statement, "body", ()))
        drawings = [
            (own.variable, self._open(own.pool)) for own in getattr(statement, "drawings", ())
        ]
        for values in product(*domains.values()):
            binding = dict(zip(domains, values, strict=True))
            if all(self._holds(condition, binding) for condition in known):
                drawn = (Draw(instance(v, binding), _each(pool, binding)) for v, pool in drawings)
                yield binding, {"body": _each(body, binding), "drawings": tuple(drawn)}

    def _open(self, body: syntax.Body) -> syntax.Body:
        return tuple(filter(self._is_open, body))

    def _is_open(self, part: syntax.Condition) -> bool:
        """Whether it depends on the state, or on what the robot does, that a condition holds."""
        kinds = FLUENTS | AGENT
        return isinstance(part, syntax.Literal) and self.signature.kind(part.atom.name) in kinds

    def _holds(self, condition: syntax.Condition, binding: Binding) -> bool:
        """Whether a comparison or a static holds; a sort does, for its variable ranges over it."""
        if isinstance(condition, syntax.Comparison):
            left, right = (binding.get(term.name, term.name) for term in condition.terms)
            return (left == right) == condition.positive
        is_sort = condition.atom.name in self.signature.sorts
        return is_sort or (instance(condition.atom, binding) in self.statics) == condition.positive


def static_truth(
    source: syntax.Source, signature: Signature
) -> tuple[frozenset[Literal], frozenset[Literal]]:
    """The statics that are true, and those that the laws leave open (through their own negation).

    The alternating fixpoint: certain facts bound the possible ones, and the reverse.
    """
    facts = frozenset(
        fact
        for stated in source.each(syntax.Fact)
        for fact in pattern_of(stated, signature, head=stated.literal).heads((), NOTHING)
    )
    laws = [
        pattern_of(law, signature, head=law.head)
        for law in source.each(syntax.StateConstraint)
        if signature.kind(law.head.atom.name) == "static"
    ]

    def closed(assumed: frozenset[Literal]) -> frozenset[Literal]:
        """The least set with the facts that is closed under the laws."""
        known = facts
        while True:
            truth = _Assumed(known, assumed)
            derived = known.union(*(law.heads((), truth) for law in laws))
            if derived == known:
                return known
            known = derived

    true: frozenset[Literal] = frozenset()
    while (surer := closed(possible := closed(true))) != true:
        true = surer
    return true, possible - true


def closed_world(statics: Iterable[Literal], signature: Signature) -> Facts:
    """The true statics of a description as facts: a static is false everywhere else."""
    return Facts(statics, (symbol.name for symbol in signature.of_kind("static")))


class _Assumed(Facts):
    """Statics known so far; one is false where it is not among the assumed ones."""

    def __init__(self, known: Iterable[Literal], assumed: Iterable[Literal]) -> None:
        super().__init__(known)
        self._assumed = Facts(assumed)

    def may_fail(self, name: str, row: Row) -> bool:
        return self._assumed.may_fail(name, row)


def pattern_of(
    statement: syntax.Statement,
    signature: Signature,
    statics: Facts = NOTHING,
    given: Sequence[syntax.Term] = (),
    head: syntax.Literal | None = None,
    also: Sequence[syntax.Literal] = (),
) -> Pattern:
    """The pattern of a statement, without the sorts of its body: its domains say them already."""
    body: Iterable[syntax.Condition] = getattr(statement, "body", ())
    conditions = [
        c for c in body if isinstance(c, syntax.Comparison) or c.atom.name not in signature.sorts
    ]
    domains = variable_domains(statement, signature)
    return Pattern(domains, conditions, statics, given, head, also)


def instance(part: Any, binding: Binding) -> Any:
    """A part of a statement with constants for its variables: ground, or a tuple of such parts."""
    if isinstance(part, syntax.Literal):
        names = [binding.get(term.name, term.name) for term in part.atom.args]
        return Literal.of(part.atom.name, names, part.positive)
    if isinstance(part, syntax.Atom):
        return Literal.of(part.name, [binding.get(term.name, term.name) for term in part.args])
    if isinstance(part, syntax.Term):
        return binding.get(part.name, part.name)
    if isinstance(part, list | tuple):
        return tuple([instance(each, binding) for each in part])
    return part


def _each(body: syntax.Body, binding: Binding) -> Literals:
    """The ground literals of a body, each once."""
    return tuple(dict.fromkeys(instance(body, binding)))


def _initially(instances: Instances) -> tuple[tuple[Fluent, ...], ...]:
    groups: dict[tuple[object, ...], list[Fluent]] = {}
    for number, statement in enumerate(instances.source.each(syntax.InitiallyStatement)):
        for binding, _ in instances.of(statement):
            others = (v for name, v in binding.items() if name != statement.variable.name)
            groups.setdefault((number, *others), []).append(instance(statement.fluent, binding))
    return tuple(map(tuple, groups.values()))


def _defaults(instances: Instances) -> tuple[Default, ...]:
    """The defaults but those to which an exception applies whatever the state."""
    exceptions: dict[str, list[Literals]] = defaultdict(list)
    for exception in instances.source.each(syntax.ExceptionStatement):
        assert exception.of is not None, "the checker has found every default"
        name = default_atom(exception.of, instances.signature)
        for binding, left in instances.of(exception):
            exceptions[instance(name, binding)].append(left["body"])
    return tuple(
        Default(of, instance(statement.head, binding), left["body"], tuple(exceptions[of]))
        for statement in instances.source.each(syntax.DefaultStatement)
        for name in [default_atom(statement, instances.signature)]
        for binding, left in instances.of(statement)
        if () not in exceptions[of := instance(name, binding)]
    )
