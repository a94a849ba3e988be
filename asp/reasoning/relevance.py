"""Which constants a plan can do without, and which ones may stand for each other.

A set X of constants is *independent* of the rest where nothing that is true of X ever changes
anything else, except by standing in the way. Then a plan for a goal that does not mention X stays
one when the actions that mention X are left out, so that no shortest plan has any; and where
nothing of X stands in the way now, the shortest plans of the restricted domain are those of the
whole one. That is read off the laws and not off their instances, so that it costs the same however
many there are; and X is made of groups, of constants that stated statics connect, as a thing and
its components.
"""

from collections.abc import Collection, Iterable, Iterator, Mapping

from asp.language import Action, Literal, Signature, named, syntax, variable_domains
from asp.language import variable_sorts as roles

Law = syntax.CausalLaw | syntax.StateConstraint | syntax.ExecutabilityCondition
Group = frozenset[str]
Domains = Mapping[str, Collection[str]]


class Relevance:
    """What can be left out of a description when planning in it.

    `independent` are the constants that are independent of all others, `obstacles` the names of
    fluents by which they may stand in the way.
    """

    def __init__(self, source: syntax.Source, signature: Signature) -> None:
        """`source` has the laws that count: without those of exogenous actions, an agent's own."""
        self._source = source
        self._signature = signature
        derived = {law.head.atom.name for law in source.each(syntax.StateConstraint)}
        statics = {symbol.name for symbol in signature.of_kind("static")}
        self._stated = statics - derived
        self._laws = [
            law
            for law in source.statements
            if isinstance(law, Law)
            and not (isinstance(law, syntax.StateConstraint) and law.head.atom.name in statics)
        ]
        atoms = (fact.literal.atom for fact in source.each(syntax.Fact))
        self._facts = [atom for atom in atoms if atom.name in self._stated]
        self.independent = self._greatest()
        self._group = self._groups(self.independent)
        self.obstacles = frozenset(
            literal.atom.name
            for law in self._laws
            for literal in self._loose(law, self.independent)
        )

    def spare(self, possible: Iterable[Action], goal: Iterable[Literal]) -> frozenset[str]:
        """The constants that shortest plans for the goal do not need.

        `possible` are the fluents that are or may be true now. Every group is needed that the goal
        names or that may be in the way.
        """
        needed = {constant for literal in goal for constant in literal.arguments}
        for fluent in possible:
            if fluent.name in self.obstacles:
                needed.update(fluent.arguments)
        nothing: Group = frozenset()
        return self.independent.difference(*(self._group.get(c, nothing) for c in needed))

    def _greatest(self) -> frozenset[str]:
        """The constants that no law names, of sorts of which none is tied to something else."""
        mentioned = {constant for law in self._laws for constant in named(law)}
        left = self._signature.constants - mentioned
        sorts = {constant: _sorts(constant, self._signature) for constant in left}
        while against := self._against(left):
            tied = {sorts[constant] for constant in against}
            left = frozenset(constant for constant in left if sorts[constant] not in tied)
        return left

    def _against(self, group: Group) -> Group:
        """Members of the group that the laws tie something else to; none if it is independent."""
        for law in self._laws:
            for literal in self._loose(law, group):
                if not self._may_be_loose(law, literal):
                    loose = self._loose_variables(law, group).intersection(_variables(literal))
                    domains = variable_domains(law, self._signature)
                    return group.intersection(*(domains[v] for v in sorted(loose)[:1]))
        return frozenset()

    def _loose(self, law: Law, group: Group) -> Iterator[syntax.Literal]:
        """The conditions on members of the group that what the law is about is not tied to."""
        # A causal law is about its effect, so that its action is a condition like others.
        loose = self._loose_variables(law, group)
        conditions = [c for c in roles.literals(law.body) if c.atom.name in self._signature.symbols]
        if isinstance(law, syntax.CausalLaw):
            conditions.append(syntax.Literal(law.action, True))
        return (c for c in conditions if loose.intersection(_variables(c)))

    def _groups(self, members: Group) -> Mapping[str, Group]:
        """Of each member those that stated statics connect it with."""
        found: dict[str, Group] = {member: frozenset([member]) for member in members}
        for fact in self._facts:
            together = members.intersection(term.name for term in fact.args)
            union = frozenset(c for member in together for c in found[member])
            found.update(dict.fromkeys(union, union))
        return found

    def _may_be_loose(self, law: Law, literal: syntax.Literal) -> bool:
        """Whether a condition on something else can only be in the way."""
        if not literal.positive or self._signature.kind(literal.atom.name) != "inertial":
            return False
        if isinstance(law, syntax.StateConstraint):
            return comes_true_only_while(literal, law.head, self._source)
        return isinstance(law, syntax.ExecutabilityCondition)

    def _loose_variables(self, law: Law, group: Group) -> set[str]:
        domains = variable_domains(law, self._signature)
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

    def _links(self, atom: syntax.Atom, domains: Domains, group: Group) -> bool:
        """Whether a condition of a law connects members of the group with members only.

        It is a static, and stated: then its true instances are the facts.
        """
        return atom.name in self._stated and all(
            len(group.intersection(t.name for t in fact.args)) in (0, len(fact.args))
            for fact in self._facts
            if fact.name == atom.name
            and all(
                value.name in domains.get(term.name, (term.name,))
                for term, value in zip(atom.args, fact.args, strict=True)
            )
        )


def interchangeable(source: syntax.Source, signature: Signature) -> tuple[tuple[str, ...], ...]:
    """Classes of constants, in order of declaration, that no law or fact tells apart."""
    mentioned = {
        constant
        for statement in source.statements
        if isinstance(statement, Law | syntax.Fact)
        for constant in named(statement)
    }
    classes: dict[frozenset[str], list[str]] = {}
    for constant in dict.fromkeys(m for members in signature.sorts.values() for m in members):
        if constant not in mentioned:
            classes.setdefault(_sorts(constant, signature), []).append(constant)
    return tuple(map(tuple, classes.values()))


def _sorts(constant: str, signature: Signature) -> frozenset[str]:
    return frozenset(sort for sort, members in signature.sorts.items() if constant in members)


def _variables(literal: syntax.Literal) -> list[str]:
    return [term.name for term in literal.atom.args if term.is_variable]


def comes_true_only_while(
    condition: syntax.Literal, head: syntax.Literal, source: syntax.Source
) -> bool:
    """Whether nothing makes a positive condition true but actions impossible while `head` is false.

    A constraint `head if condition` then says only what was so already when the condition came
    true. Decided by the form of the laws: False where that does not tell.
    """
    laws: list[syntax.CausalLaw | syntax.StateConstraint]
    laws = [*source.each(syntax.StateConstraint), *source.each(syntax.CausalLaw)]
    name = condition.atom.name
    makers = [law for law in laws if law.head.positive and law.head.atom.name == name]
    return all(
        isinstance(law, syntax.CausalLaw) and _is_guarded(law, condition, head, source)
        for law in makers
    )


def _is_guarded(
    maker: syntax.CausalLaw, condition: syntax.Literal, head: syntax.Literal, source: syntax.Source
) -> bool:
    """Whether an executability condition forbids the action, as far as it makes the condition true.

    That is, one without other conditions than that the head is false.
    """
    made = _bound(maker.head.atom.args, _names(condition.atom))
    if made is None:
        return False
    action = [made.get(name, name) for name in _names(maker.action)]
    return any(
        hindered.name == maker.action.name
        and (literal.atom.name, literal.positive) == (head.atom.name, not head.positive)
        and _bound((*hindered.args, *literal.atom.args), (*action, *_names(head.atom))) is not None
        for hindered, literal in _simple_hindrances(source)
    )


def _simple_hindrances(source: syntax.Source) -> Iterator[tuple[syntax.Atom, syntax.Literal]]:
    """The actions that are impossible while one literal holds, whatever else does."""
    for law in source.each(syntax.ExecutabilityCondition):
        if len(law.actions) == len(law.body) == 1 and isinstance(law.body[0], syntax.Literal):
            yield law.actions[0], law.body[0]


def _names(atom: syntax.Atom) -> list[str]:
    return [term.name for term in atom.args]


def _bound(pattern: Iterable[syntax.Term], given: Iterable[str]) -> dict[str, str] | None:
    """What the variables of a pattern stand for where it becomes the given terms, if it does."""
    found: dict[str, str] = {}
    for term, value in zip(pattern, given, strict=True):
        if value != (found.setdefault(term.name, value) if term.is_variable else term.name):
            return None
    return found
