"""A description as planning operators over variables: what planners other than ours can read.

Fluents that exclude each other become the values of one variable. Each agent action becomes one
operator for each case that its laws and the state constraints distinguish, so that operators have
a conjunction of values as precondition and assignments as effects, and nothing else. The states
and transitions are those of the description; the tests hold this against the compiled world.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass

from asp.description import Causal, Constraint, Description
from asp.literals import atom, complement, is_positive

NONE = "none"
FALSE, TRUE = "false", "true"

Literals = tuple[str, ...]
Values = Mapping[str, str]
"""Of each variable, named by one of its fluents, a value: a fluent, NONE, TRUE or FALSE."""


class NotEncodableError(ValueError):
    """A description with defined fluents, or with a transition that has several outcomes."""


@dataclass(frozen=True)
class Operator:
    """An agent action in one of its cases."""

    action: str
    before: Values
    after: Values


class Encoding:
    """The variables of a description and its operators. Raises NotEncodableError."""

    def __init__(self, description: Description) -> None:
        if description.defined:
            raise NotEncodableError("defined fluents are not encoded")
        self._description = description
        self.variable: dict[str, str] = {}
        self.domain: dict[str, tuple[str, ...]] = {}
        for group in _groups(description):
            name = group[0]
            self.variable.update(dict.fromkeys(group, name))
            always = len(group) > 1 and _always_one(description, group)
            more = () if always else (NONE,)
            self.domain[name] = (*group, *more) if len(group) > 1 else (TRUE, FALSE)
        self._constraints = [c for c in description.constraints if not self._excludes(c)]
        self._triggered: dict[str, list[Constraint]] = {}
        for law in self._constraints:
            for literal in law.body:
                self._triggered.setdefault(literal, []).append(law)
        self.operators = tuple(
            operator for action in description.agent_actions for operator in self._cases(action)
        )

    def values(self, true: Iterable[str]) -> dict[str, str]:
        """The state in which these fluents are true and all others false."""
        state = {name: NONE if NONE in values else FALSE for name, values in self.domain.items()}
        for fluent in true:
            state.update([self._assign(fluent)])
        return state

    def holds(self, literal: str, values: Values) -> bool | None:
        """Whether the literal is true; None where the values do not decide it."""
        variable, value = self._assign(atom(literal))
        if variable not in values:
            return None
        return (values[variable] == value) == is_positive(literal)

    def assignment(self, literal: str) -> tuple[str, str, bool]:
        """The variable of a literal, the value it speaks of, and whether it claims or denies it."""
        return (*self._assign(atom(literal)), is_positive(literal))

    def _assign(self, fluent: str) -> tuple[str, str]:
        variable = self.variable[fluent]
        return variable, TRUE if TRUE in self.domain[variable] else fluent

    def _excludes(self, law: Constraint) -> bool:
        """Whether the constraint says that two values of one variable exclude each other."""
        if is_positive(law.head) or len(law.body) != 1 or not is_positive(law.body[0]):
            return False
        return self.variable[atom(law.head)] == self.variable[law.body[0]]

    def _cases(self, action: str) -> Iterator[Operator]:
        laws = [law for law in self._description.causal if law.action == action]
        bodies = [e.body for e in self._description.executability if e.actions == (action,)]
        branches: list[dict[str, str]] = [{}]
        while branches:
            before = self._implied(branches.pop())
            if before is None:
                continue
            blocked, open_body = self._blocked(bodies, before)
            if blocked:
                continue
            if open_body is not None:
                branches += self._split(open_body, before)
                continue
            undecided, after = self._outcome(laws, before)
            if undecided is not None:
                branches += self._split(undecided, before)
            elif after is not None:
                yield Operator(action, before, after)

    def _implied(self, before: dict[str, str]) -> dict[str, str] | None:
        """With the values that the constraints imply; None where there is no such state."""
        size = -1
        while size != len(before):
            size = len(before)
            for law in self._constraints:
                if not is_positive(law.head) or not all(self.holds(b, before) for b in law.body):
                    continue
                if self.holds(law.head, before) is False:
                    return None
                before = {**before, **dict([self._assign(law.head)])}
        return before

    def _blocked(self, bodies: list[Literals], before: Values) -> tuple[bool, str | None]:
        """Whether a body holds; and a literal of one that is not decided yet."""
        undecided = None
        for body in bodies:
            truths = [self.holds(literal, before) for literal in body]
            if all(truths):
                return True, None
            if False not in truths and undecided is None:
                undecided = body[truths.index(None)]
        return False, undecided

    def _split(self, literal: str, before: Values) -> Iterator[dict[str, str]]:
        variable = self.variable[atom(literal)]
        for value in self.domain[variable]:
            yield {**before, variable: value}

    def _outcome(
        self, laws: Iterable[Causal], before: Values
    ) -> tuple[str | None, dict[str, str] | None]:
        """A literal still to be decided, or the assignments; neither if effects conflict."""
        known: list[str] = []
        for law in laws:
            truths = [self.holds(literal, before) for literal in law.body]
            if None in truths and False not in truths:
                return law.body[truths.index(None)], None
            if all(truths):
                known.append(law.head)
        for effect in known:  # grows while it is read
            for constraint in self._triggered.get(effect, ()):
                now = self._now(known, before)
                truths = [
                    True if literal in known else self.holds(literal, now)
                    for literal in constraint.body
                ]
                if None in truths and False not in truths:
                    return constraint.body[truths.index(None)], None
                if all(truths) and constraint.head not in known:
                    known.append(constraint.head)
        if any(complement(effect) in known for effect in known):
            return None, None
        positive = [self._assign(effect) for effect in known if is_positive(effect)]
        if len(dict(positive)) < len(set(positive)):
            return None, None
        return self._negative(known, before, dict(positive))

    def _negative(
        self, known: Iterable[str], before: Values, after: dict[str, str]
    ) -> tuple[str | None, dict[str, str] | None]:
        for effect in known:
            variable, value = self._assign(atom(effect))
            if is_positive(effect) or variable in after:
                continue
            if variable not in before:
                return effect, None
            if before[variable] == value:
                after[variable] = FALSE if value == TRUE else NONE
        return None, {v: value for v, value in after.items() if before.get(v) != value}

    def _now(self, known: Iterable[str], before: Values) -> dict[str, str]:
        return {**before, **dict(self._assign(e) for e in known if is_positive(e))}


def _groups(description: Description) -> Iterator[list[str]]:
    """The fluents in groups of which at most one is true, by constraints `-f if g` each way."""
    excluded: dict[str, set[str]] = {fluent: set() for fluent in description.fluents}
    for law in description.constraints:
        if not is_positive(law.head) and len(law.body) == 1 and is_positive(law.body[0]):
            excluded[atom(law.head)].add(law.body[0])
    done: set[str] = set()
    for fluent in description.fluents:
        if fluent in done:
            continue
        group = [fluent]
        for other in description.fluents:
            if other not in done and all(
                other in excluded[member] and member in excluded[other] for member in group
            ):
                group.append(other)
        done.update(group)
        yield group


def _always_one(description: Description, group: list[str]) -> bool:
    """Whether some fluent of the group is true at first, and none is ever made false alone."""
    members = set(group)
    heads = {law.head for law in description.causal}
    heads |= {law.head for law in description.constraints if not members.issuperset(law.body)}
    given = any(set(some) <= members for some in description.initially)
    return given and heads.isdisjoint(map(complement, group))
