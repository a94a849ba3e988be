"""A description as planning operators over variables with a few values each (SAS+).

Fluents that exclude each other become the values of one variable. Each agent action becomes one
operator for each case that its laws and the state constraints distinguish, so that operators have
a conjunction of values as precondition and assignments as effects, and nothing else. The states
and transitions are those of the description.
"""

from collections.abc import Collection, Iterable, Iterator
from dataclasses import dataclass

from asp.language import Action, Description, Fluent, Literal
from asp.reasoning.planning.large.outcomes import Law, Laws, NotEncodableError

Values = tuple[tuple[int, int], ...]
"""Variables, each with a value, both by number."""


@dataclass(frozen=True)
class Operator:
    """An agent action in one of its cases; `after` are the values that it changes."""

    action: Action
    before: Values
    after: Values


class Encoding:
    """The variables of a description and its operators. Raises NotEncodableError.

    `domains` are the values of each variable: fluents, of which this one is true, and None where
    none of them may be.
    """

    def __init__(self, description: Description) -> None:
        if description.defined:
            raise NotEncodableError("defined fluents are not encoded")
        self.domains = tuple(_domain(description, group) for group in _groups(description))
        self._entries = {
            fluent: (variable, value)
            for variable, domain in enumerate(self.domains)
            for value, fluent in enumerate(domain)
            if fluent is not None
        }
        constraints = (self._law(law.head, law.body) for law in description.constraints)
        self._laws = Laws(
            (law for law in constraints if not _excludes_values(law)), list(map(len, self.domains))
        )
        self.operators = tuple(self._operators(description))
        self._by_action: dict[Action, list[Operator]] = {}
        for operator in self.operators:
            self._by_action.setdefault(operator.action, []).append(operator)

    def values(self, true: Collection[Fluent]) -> tuple[int, ...] | None:
        """The state in which these fluents are true, a value of each variable; None: no state."""
        state = [domain.index(None) if None in domain else -1 for domain in self.domains]
        for fluent in true:
            variable, value = self._entries[fluent]
            state[variable] = value
        if -1 in state:
            return None
        said = {domain[value] for domain, value in zip(self.domains, state, strict=True)}
        return tuple(state) if said - {None} == set(true) and self._laws.hold(state) else None

    def after(self, state: tuple[int, ...], action: Action) -> tuple[int, ...] | None:
        """The state that an agent action leads to; None where it is impossible."""
        for operator in self._by_action.get(action, ()):
            if all(state[variable] == value for variable, value in operator.before):
                changed = dict(operator.after)
                return tuple(changed.get(variable, value) for variable, value in enumerate(state))
        return None

    def assignment(self, literal: Literal) -> tuple[int, int, bool]:
        """The variable of a literal, the value it speaks of, and whether it claims or denies it."""
        return (*self._entries[literal.atom], literal.is_positive)

    def _law(self, head: Literal, body: Iterable[Literal]) -> Law:
        return Law(self.assignment(head), tuple(map(self.assignment, body)))

    def _operators(self, description: Description) -> Iterator[Operator]:
        effects: dict[Action, list[Law]] = {}
        for causal in description.causal:
            effects.setdefault(causal.action, []).append(self._law(causal.head, causal.body))
        hindrances: dict[Action, list[tuple[tuple[int, int, bool], ...]]] = {}
        for condition in description.executability:
            if len(set(condition.actions)) == 1:
                body = tuple(map(self.assignment, condition.body))
                hindrances.setdefault(condition.actions[0], []).append(body)
        for action in description.agent_actions:
            cases = self._laws.cases(effects.get(action, []), hindrances.get(action, []))
            for before, after in cases:
                if after is None:
                    raise NotEncodableError(f"{action} may have several outcomes")
                yield Operator(action, before, after)


def _excludes_values(law: Law) -> bool:
    """Whether a constraint says only that two values of one variable exclude each other."""
    (variable, value, claims), body = law.head, law.body
    return (
        not claims and len(body) == 1 and body[0][::2] == (variable, True) and body[0][1] != value
    )


def _groups(description: Description) -> Iterator[list[Fluent]]:
    """The fluents in groups of which at most one is true, by constraints `-f if g` each way."""
    excluded: dict[Fluent, set[Fluent]] = {fluent: set() for fluent in description.fluents}
    for law in description.constraints:
        if not law.head.is_positive and len(law.body) == 1 and law.body[0].is_positive:
            excluded[law.head.atom].add(law.body[0])
    left = list(description.fluents)
    while left:
        group: list[Literal] = []
        for fluent in left:
            if all(fluent in excluded[other] and other in excluded[fluent] for other in group):
                group.append(fluent)
        yield group
        left = [fluent for fluent in left if fluent not in group]


def _domain(description: Description, group: list[Fluent]) -> tuple[Fluent | None, ...]:
    """The values of a group: no None where one is true at first, and none is made false alone."""
    members = set(group)
    heads = {law.head for law in description.causal}
    heads |= {law.head for law in description.constraints if not members.issuperset(law.body)}
    given = any(set(some) <= members for some in description.initially)
    unmade = heads.isdisjoint(each.complement for each in group)
    return (*group,) if len(group) > 1 and given and unmade else (*group, None)
