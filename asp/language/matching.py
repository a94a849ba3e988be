"""Statements as patterns: instances that apply are found by way of the atoms that are there.

What is cheapest comes first: a condition all of whose variables are bound is tested, one that binds
a variable by way of an index follows, and only a variable that no positive literal binds runs over
its sort.
"""

from collections.abc import Callable, Collection, Iterable, Iterator, Mapping, Sequence
from operator import itemgetter
from typing import Protocol, TypeAlias

from asp.language import syntax
from asp.language.description import Constraint
from asp.language.literals import Literal

Row: TypeAlias = tuple[str, ...]
"""The arguments of a ground atom."""
Values: TypeAlias = dict[str, str]
"""The values of a statement's variables; a constant has itself for a value."""


class Truth(Protocol):
    """What may be true and what may be false, as far as a condition asks for it."""

    def may_hold(self, name: str, row: Row) -> bool: ...

    def may_fail(self, name: str, row: Row) -> bool: ...

    def rows(self, name: str) -> Collection[Row]:
        """The atoms of a name that may be true."""

    def having(self, name: str, place: int, value: str) -> Iterable[Row]:
        """Those of them that have the value at the place, counted from 0."""


class Facts:
    """A set of true atoms; all others are false. An index is built when it is first asked for.

    `names` are further names of which something is known: that no atom is true.
    """

    def __init__(self, atoms: Iterable[Literal], names: Iterable[str] = ()) -> None:
        self._rows: dict[str, dict[Row, None]] = {name: {} for name in names}
        for atom in sorted(atoms):
            self._rows.setdefault(atom.name, {})[atom.arguments] = None
        self._indices: dict[tuple[str, int], dict[str, list[Row]]] = {}

    def __contains__(self, name: str) -> bool:
        return name in self._rows

    def may_hold(self, name: str, row: Row) -> bool:
        return row in self._rows.get(name, ())

    def may_fail(self, name: str, row: Row) -> bool:
        return row not in self._rows.get(name, ())

    def rows(self, name: str) -> Collection[Row]:
        return self._rows.get(name, ())

    def having(self, name: str, place: int, value: str) -> Sequence[Row]:
        index = self._indices.get((name, place))
        if index is None:
            index = self._indices[name, place] = {}
            for row in self._rows.get(name, ()):
                index.setdefault(row[place], []).append(row)
        return index.get(value, ())


NOTHING = Facts(())

Fits: TypeAlias = Callable[[Row, Values], bool]
Source: TypeAlias = Callable[[Values, Truth], Iterable[Row]]
Test: TypeAlias = Callable[[Values, Truth], bool]
Level: TypeAlias = tuple[Fits, list[Test], Source | None]
"""Whether a row fits what is bound (it binds the rest), what is tested then, the next rows."""


class Pattern:
    """A statement whose terms `given` are known; the rest of it is searched for.

    `domains` is what its variables range over: a value outside fits nothing. Conditions on what
    `statics` knows of are asked of them, others of the truth at hand; of these an instance tells,
    but not of those in `also`.
    """

    def __init__(
        self,
        domains: Mapping[str, Collection[str]],
        conditions: Sequence[syntax.Condition],
        statics: Facts,
        given: Sequence[syntax.Term] = (),
        head: syntax.Literal | None = None,
        also: Sequence[syntax.Literal] = (),
    ) -> None:
        self._domains = {variable: frozenset(members) for variable, members in domains.items()}
        self._statics = statics
        self.head = ("", True) if head is None else (head.atom.name, head.positive)
        self._head = None if head is None else _maker(head)
        literals = (c for c in conditions if isinstance(c, syntax.Literal))
        self._body = tuple(_maker(c) for c in literals if c.atom.name not in statics)
        parts = [given, *(c.terms for c in conditions), () if head is None else head.terms]
        self._terms = {term.name: term for part in parts for term in part}
        self._constants = {n: n for n, term in self._terms.items() if not term.is_variable}
        self._levels = list(self._plan(given, [*conditions, *also]))

    def matches(self, given: Row, truth: Truth) -> Iterator[Values]:
        """The values of each match, in a dictionary that is used again afterwards."""
        return self._search(0, [given], self._constants.copy(), truth)

    def heads(self, given: Row, truth: Truth) -> Iterator[Literal]:
        """The heads of the instances that may apply."""
        assert self._head is not None
        return map(self._head, self.matches(given, truth))

    def bodies(self, given: Row, truth: Truth) -> Iterator[tuple[Literal, ...]]:
        """Their bodies."""
        return (tuple(make(v) for make in self._body) for v in self.matches(given, truth))

    def instances(self, given: Row, truth: Truth) -> Iterator[Constraint]:
        """The instances that may apply."""
        assert self._head is not None
        for values in self.matches(given, truth):
            yield Constraint(self._head(values), tuple(make(values) for make in self._body))

    def _search(
        self, number: int, rows: Iterable[Row], values: Values, truth: Truth
    ) -> Iterator[Values]:
        fits, tests, following = self._levels[number]
        for row in rows:
            if fits(row, values):
                for test in tests:
                    if not test(values, truth):
                        break
                else:
                    if following is None:
                        yield values
                    else:
                        more = following(values, truth)
                        yield from self._search(number + 1, more, values, truth)

    def _plan(
        self, terms: Sequence[syntax.Term], left: Sequence[syntax.Condition]
    ) -> Iterator[Level]:
        bound: frozenset[str] = frozenset()
        source: Source | None
        while True:
            fits = self._fitting(terms, bound)
            bound |= _variables(terms)
            ready = [c for c in left if _variables(c.terms) <= bound]
            left = [c for c in left if c not in ready]
            positive = [c for c in left if isinstance(c, syntax.Literal) and c.positive]
            if positive:
                cheapest = min(positive, key=lambda literal: self._cost(literal.atom, bound))
                left = [c for c in left if c is not cheapest]
                source, terms = self._source(cheapest.atom, bound), cheapest.terms
            elif missing := [v for v in self._domains if v in self._terms and v not in bound]:
                name = min(missing, key=lambda variable: len(self._domains[variable]))
                source, terms = self._members(name), [self._terms[name]]
            else:
                source = None
            yield fits, list(map(self._test, ready)), source
            if source is None:
                return

    def _fitting(self, terms: Sequence[syntax.Term], bound: frozenset[str]) -> Fits:
        """Whether a row fits the terms, given the bound variables; binds the others."""
        first: dict[str, int] = {}  # where a variable stands that is bound here
        for place, term in enumerate(terms):
            if term.is_variable and term.name not in bound:
                first.setdefault(term.name, place)
        binds = [(place, name, self._domains[name]) for name, place in first.items()]
        same = [(n, term.name) for n, term in enumerate(terms) if first.get(term.name) != n]

        def fits(row: Row, values: Values) -> bool:
            for place, variable, domain in binds:
                value = row[place]
                if value not in domain:
                    return False
                values[variable] = value
            for place, name in same:  # noqa: SIM110 - the loop is faster
                if row[place] != values[name]:
                    return False
            return True

        return fits

    def _cost(self, atom: syntax.Atom, bound: frozenset[str]) -> float:
        """The rows to look at: known of the statics, a guess for what changes."""
        keys = _bound_places(atom, bound)
        if atom.name not in self._statics:
            return 2 if keys else 1000
        rows = self._statics.rows(atom.name)
        return len(rows) / max(1, *(len({row[place] for row in rows}) for place, _ in keys), 1)

    def _source(self, atom: syntax.Atom, bound: frozenset[str]) -> Source:
        name, statics = atom.name, self._statics if atom.name in self._statics else None
        keys = _bound_places(atom, bound)
        if not keys:
            return lambda _, truth: (statics or truth).rows(name)
        place, key = keys[0]
        return lambda values, truth: (statics or truth).having(name, place, values[key])

    def _members(self, variable: str) -> Source:
        members = [(member,) for member in sorted(self._domains[variable])]
        return lambda _, __: members

    def _test(self, condition: syntax.Condition) -> Test:
        if isinstance(condition, syntax.Comparison):
            left, right, positive = condition.left.name, condition.right.name, condition.positive
            return lambda values, _: (values[left] == values[right]) == positive
        name, row, positive = condition.atom.name, _row(condition.atom), condition.positive
        if name in self._statics:
            rows = self._statics.rows(name)
            return lambda values, _: (row(values) in rows) == positive
        if positive:
            return lambda values, truth: truth.may_hold(name, row(values))
        return lambda values, truth: truth.may_fail(name, row(values))


def _bound_places(atom: syntax.Atom, bound: frozenset[str]) -> list[tuple[int, str]]:
    return [
        (place, term.name)
        for place, term in enumerate(atom.args)
        if not term.is_variable or term.name in bound
    ]


def _maker(literal: syntax.Literal) -> Callable[[Values], Literal]:
    name, row, positive = literal.atom.name, _row(literal.atom), literal.positive
    return lambda values: Literal.of(name, row(values), positive)


def _row(atom: syntax.Atom) -> Callable[[Values], Row]:
    names = [term.name for term in atom.args]
    if len(names) > 1:
        return itemgetter(*names)
    return lambda values: tuple([values[name] for name in names])


def _variables(terms: Iterable[syntax.Term]) -> frozenset[str]:
    return frozenset(term.name for term in terms if term.is_variable)
