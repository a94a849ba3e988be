"""Which constants of a lifted description a plan can do without.

As `asp.reasoning.planning.relevance` has it: a set X of constants is independent of the rest where
nothing that is true of X ever changes anything else, except by standing in the way. Here that is
read off the laws and not off their instances, so that it costs the same however many there are; and
X is made of groups, of constants that stated statics connect, as a thing and its components.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass
from functools import cached_property

from asp.language import Signature, arguments, named, syntax, variable_domains, without_exogenous
from asp.language import variable_sorts as roles
from asp.reasoning.fine_planning.guarded_fluents import comes_true_only_while

Law = syntax.CausalLaw | syntax.StateConstraint | syntax.ExecutabilityCondition
Group = frozenset[str]
Domains = Mapping[str, frozenset[str]]


class Sparing:
    """What can be left out of a description when planning in it."""

    def __init__(self, source: syntax.Source, signature: Signature) -> None:
        self._description = _Lifted(without_exogenous(source, signature), signature)
        self.independent = self._greatest()
        self._group = self._description.groups(self.independent)
        # Names with what stands behind them in a fluent, so that no other name begins like one.
        self._obstacles = tuple(
            literal.atom.name + ("(" if literal.atom.args else "")
            for law in self._description.laws
            if isinstance(law, syntax.ExecutabilityCondition)
            for literal in self._description.loose(law, self.independent)
        )

    def spare(self, possible: Iterable[str], goal: Iterable[str]) -> frozenset[str]:
        """The constants that shortest plans for the goal do not need.

        `possible` are the fluents that are or may be true now. Every group is needed that the goal
        names or that may be in the way.
        """
        needed = {constant for literal in goal for constant in arguments(literal)}
        for fluent in possible:
            if fluent.startswith(self._obstacles):
                needed.update(arguments(fluent))
        nothing: Group = frozenset()
        return self.independent.difference(*(self._group.get(c, nothing) for c in needed))

    def _greatest(self) -> frozenset[str]:
        """Kinds of constants are taken out until nothing speaks against those that are left."""
        kinds = self._description.kinds()
        while True:
            left = frozenset().union(*kinds)
            against = self._description.against(left)
            if not against:
                return left
            kinds = [kind for kind in kinds if kind.isdisjoint(against)]


@dataclass(frozen=True)
class _Lifted:
    """Laws whose variables are looked at, not their instances."""

    source: syntax.Source
    signature: Signature

    @cached_property
    def laws(self) -> list[Law]:
        statements = self.source.statements
        return [s for s in statements if isinstance(s, Law) and not self._static(s)]

    def kinds(self) -> list[Group]:
        """The constants that no law names, those together that are of the same sorts."""
        mentioned = {constant for law in self.laws for constant in named(law)}
        found: dict[frozenset[str], set[str]] = {}
        for constant in self.signature.constants - mentioned:
            sorts = frozenset(s for s, ms in self.signature.sorts.items() if constant in ms)
            found.setdefault(sorts, set()).add(constant)
        return [frozenset(kind) for kind in found.values()]

    def against(self, group: Group) -> Group:
        """Members of the group that the laws tie something else to; none if it is independent."""
        for law in self.laws:
            for literal in self.loose(law, group):
                if not self._may_be_loose(law, literal):
                    loose = self._loose_variables(law, group).intersection(_variables(literal))
                    return group.intersection(*(self._domains(law)[v] for v in sorted(loose)[:1]))
        return frozenset()

    def loose(self, law: Law, group: Group) -> Iterator[syntax.Literal]:
        """The conditions on members of the group that what the law is about is not tied to.

        A causal law is about its effect, so that its action is a condition like others.
        """
        loose = self._loose_variables(law, group)
        conditions = [*roles.literals(law.body)]
        if isinstance(law, syntax.CausalLaw):
            conditions.append(syntax.Literal(law.action, True))
        return (c for c in conditions if not self._is_sort(c) and loose.intersection(_variables(c)))

    def _may_be_loose(self, law: Law, literal: syntax.Literal) -> bool:
        """Whether a condition on something else can only be in the way."""
        symbol = self.signature.symbols[literal.atom.name]
        if not literal.positive or symbol.kind != "inertial":
            return False
        if isinstance(law, syntax.StateConstraint):
            return comes_true_only_while(literal, law.head, self.source)
        return isinstance(law, syntax.ExecutabilityCondition)

    def _loose_variables(self, law: Law, group: Group) -> set[str]:
        domains = self._domains(law)
        possible = {v for v, members in domains.items() if not group.isdisjoint(members)}
        heads = law.actions if isinstance(law, syntax.ExecutabilityCondition) else (law.head.atom,)
        tied = {term.name for head in heads for term in head.args} & possible
        links = [
            {term.name for term in literal.atom.args} & possible
            for literal in roles.literals(law.body)
            if literal.positive and self._links(literal.atom, domains, group)
        ]
        while any(len(link & tied) not in (0, len(link)) for link in links):
            tied.update(*(link for link in links if link & tied))
        return possible - tied

    def groups(self, members: Group) -> Mapping[str, Group]:
        """Of each member those that stated statics connect it with."""
        found: dict[str, Group] = {member: frozenset([member]) for member in members}
        for fact in self._facts:
            together = members.intersection(term.name for term in fact.args)
            union = frozenset(c for member in together for c in found[member])
            found.update(dict.fromkeys(union, union))
        return found

    def _links(self, atom: syntax.Atom, domains: Domains, group: Group) -> bool:
        """Whether a condition of a law connects members of the group with members only.

        It is a static, and stated: then its true instances are the facts.
        """
        if atom.name not in self._stated:
            return False
        return all(
            len(group.intersection(t.name for t in fact.args)) in (0, len(fact.args))
            for fact in self._facts
            if fact.name == atom.name
            and all(
                value.name in domains.get(term.name, (term.name,))
                for term, value in zip(atom.args, fact.args, strict=True)
            )
        )

    @cached_property
    def _stated(self) -> frozenset[str]:
        """The statics that no law derives."""
        derived = {law.head.atom.name for law in self.source.each(syntax.StateConstraint)}
        kinds = self.signature.symbols.items()
        return frozenset(n for n, s in kinds if s.kind == "static" and n not in derived)

    @cached_property
    def _facts(self) -> list[syntax.Atom]:
        """What is stated of statics."""
        stated = (fact.literal.atom for fact in self.source.each(syntax.Fact))
        return [fact for fact in stated if fact.name in self._stated]

    def _domains(self, law: Law) -> Domains:
        found = variable_domains(law, self.signature).items()
        return {variable: frozenset(members) for variable, members in found}

    def _static(self, law: Law) -> bool:
        return (
            isinstance(law, syntax.StateConstraint)
            and self.signature.symbols[law.head.atom.name].kind == "static"
        )

    def _is_sort(self, literal: syntax.Literal) -> bool:
        return literal.atom.name in self.signature.sorts


def _variables(literal: syntax.Literal) -> list[str]:
    return [term.name for term in literal.atom.args if term.is_variable]
