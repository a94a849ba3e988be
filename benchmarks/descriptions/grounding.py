"""The instances of the statements of a description, one by one.

Nothing here is shared with `asp.language`, which reads and grounds the text of a description.
"""

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from itertools import chain, combinations, product

from benchmarks.descriptions.text import EQUAL, STATIC, Atom, Description, Statement


@dataclass(frozen=True)
class Instance:
    """A ground statement: its body is literals of fluents; whatever else stood there is true.

    `name` is that of the default which it is or is about, with the values of its variables.
    """

    heads: tuple[str, ...]
    body: tuple[str, ...]
    binding: Mapping[str, str]
    name: str


class Grounding:
    """The ground statements of a description, in which statics are evaluated away."""

    def __init__(self, description: Description) -> None:
        self._known = description
        kinds = {symbol.name: symbol.kind for symbol in description.symbols}
        self._statics = {name for name, kind in kinds.items() if kind == STATIC}
        self._fluents = {name for name, kind in kinds.items() if kind in ("inertial", "defined")}

    def instances(self, kind: str) -> Iterator[tuple[Statement, Instance]]:
        """The instances of the statements of a kind that no comparison, sort or static rules out.

        A law about statics has none: they are among what is known of `statics`.
        """
        for statement in self._of(kind):
            if not self._is_static(statement):
                for binding in self._bindings(statement):
                    instance = self._instance(statement, binding, self.statics)
                    if instance is not None:
                        yield statement, instance

    @cached_property
    def statics(self) -> frozenset[str]:
        """The statics that are true: the set that follows where the others are false."""
        every = self._known.atoms(STATIC)
        laws = [law for law in (*self._of("fact"), *self._of("law")) if self._is_static(law)]
        assumed = chain.from_iterable(combinations(every, n) for n in range(len(every) + 1))
        (found,) = (true for true in map(frozenset, assumed) if self._derived(laws, true) == true)
        return found

    def _derived(self, laws: Sequence[Statement], assumed: frozenset[str]) -> frozenset[str]:
        """What the laws derive where a static that is not assumed is false."""
        rules = [
            (_bound(law.heads, binding), _bound(law.body, binding))
            for law in laws
            for binding in self._bindings(law)
        ]
        true: set[str] = set()
        while True:
            known = len(true)
            for heads, body in rules:
                if all(
                    each.ground in true
                    if each.positive and each.name in self._statics
                    else self._allowed(each, assumed)
                    for each in body
                ):
                    true.update(head.ground for head in heads)
            if len(true) == known:
                return frozenset(true)

    def _bindings(self, statement: Statement) -> Iterator[dict[str, str]]:
        """Constants for a statement's variables: those that are of the sorts of all their places.

        The variables of an exception are also those of its default, those of which come first.
        """
        ranges: dict[str, list[str]] = {}
        for atom in self._scope(statement):
            for term, sort in zip(atom.terms, self._places(atom), strict=True):
                if term[0].isupper():
                    members = self._known.members(sort)
                    ranges[term] = [m for m in ranges.get(term, members) if m in members]
        for values in product(*ranges.values()):
            yield dict(zip(ranges, values, strict=True))

    def _scope(self, statement: Statement) -> Iterator[Atom]:
        if statement.kind == "exception":
            yield from self._scope(self._default(statement.name))
        yield from (each for each in (*statement.heads, *statement.body) if each.name != EQUAL)

    def _instance(
        self, statement: Statement, binding: Mapping[str, str], statics: frozenset[str]
    ) -> Instance | None:
        body = _bound(statement.body, binding)
        about_fluents = [each for each in body if each.name in self._fluents]
        if all(self._allowed(each, statics) for each in body if each not in about_fluents):
            heads = tuple(head.ground for head in _bound(statement.heads, binding))
            literals = tuple(each.ground for each in about_fluents)
            return Instance(heads, literals, binding, self._name(statement, binding))
        return None

    def _name(self, statement: Statement, binding: Mapping[str, str]) -> str:
        if statement.kind not in ("default", "exception"):
            return ""
        scope = self._scope(self._default(statement.name))
        variables = dict.fromkeys(term for atom in scope for term in atom.terms if term in binding)
        return Atom(statement.name, tuple(variables)).bound(binding).ground

    def _default(self, name: str) -> Statement:
        return next(each for each in self._of("default") if each.name == name)

    def _allowed(self, condition: Atom, statics: frozenset[str]) -> bool:
        """Whether a comparison, a sort or a static holds."""
        if condition.name == EQUAL:
            return (condition.terms[0] == condition.terms[1]) == condition.positive
        if condition.name in self._known.sorts:
            return condition.terms[0] in self._known.members(condition.name)
        return (condition._replace(positive=True).ground in statics) == condition.positive

    def _of(self, kind: str) -> Iterator[Statement]:
        return (statement for statement in self._known.statements if statement.kind == kind)

    def _is_static(self, statement: Statement) -> bool:
        return any(head.name in self._statics for head in statement.heads)

    def _places(self, atom: Atom) -> tuple[str, ...]:
        if atom.name in self._known.sorts:
            return (atom.name,)
        return next(symbol.sorts for symbol in self._known.symbols if symbol.name == atom.name)


def _bound(atoms: Iterable[Atom], binding: Mapping[str, str]) -> list[Atom]:
    return [atom.bound(binding) for atom in atoms]
