"""The change of a state by a set of literals: a small problem of the atoms that may change.

Of a state that is closed under the constraints nothing changes but what the new literals reach.
`touched` is a superset of that: it is closed under every constraint that fires when the new
literals, everything they may derive, and everything that was true are all taken for possible, and
under the loss of whatever a defined fluent may have been derived from. A defined fluent that may
fall by its own falling alone (`Laws.wavering`) is taken for possibly false from the start. All
other atoms keep their value in every outcome, so that they can be evaluated away, and the
outcomes are the models of a problem over the touched atoms alone, which the closure of ground
rules finds as in a small world.
"""

from collections import defaultdict
from collections.abc import Collection, Iterable, Mapping
from functools import cached_property

from asp.language import Constraint, Facts, Fluent, Literal, Row
from testbed.world.closure import Closure, LiteralSets
from testbed.world.matched.laws import Laws


class Possibilities:
    """Facts, and literals that may hold beside or instead of them."""

    def __init__(self, facts: Facts) -> None:
        self._facts = facts
        self._touched: dict[str, dict[Row, bool]] = defaultdict(dict)
        self.touched: list[Fluent] = []
        """The atoms that may change, in the order found."""

    def add(self, literal: Literal) -> bool:
        """Whether the literal is new, being neither a fact nor about what is touched already."""
        name, row, positive = literal.name, literal.arguments, literal.is_positive
        if self._facts.may_hold(name, row) == positive or row in self._touched[name]:
            return False
        self._touched[name][row] = positive
        self.touched.append(literal.atom)
        return True

    def may_hold(self, name: str, row: Row) -> bool:
        return row in self._touched[name] or self._facts.may_hold(name, row)

    def may_fail(self, name: str, row: Row) -> bool:
        return row in self._touched[name] or self._facts.may_fail(name, row)

    def rows(self, name: str) -> Collection[Row]:
        return [*self._facts.rows(name), *self._new(name)]

    def having(self, name: str, place: int, value: str) -> Collection[Row]:
        new = (row for row in self._new(name) if row[place] == value)
        return [*self._facts.having(name, place, value), *new]

    def _new(self, name: str) -> Iterable[Row]:
        return [row for row, positive in self._touched[name].items() if positive]


class Change:
    """The outcomes of making `literals` true in `facts`.

    Where nothing is closed yet (a state that is being described), `seeds` are literals that the
    constraints add to the facts by themselves.
    """

    def __init__(
        self, laws: Laws, facts: Facts, literals: Iterable[Literal], seeds: Iterable[Literal] = ()
    ) -> None:
        self._laws, self._facts = laws, facts
        self._given = tuple(literals)
        self._possible = Possibilities(facts)
        falling = (
            Literal.of(name, row, False) for name in laws.wavering for row in facts.rows(name)
        )
        self._spread([*self._given, *seeds, *falling])
        self.touched = self._possible.touched
        self._numbers = {atom: number for number, atom in enumerate(self.touched)}
        self._sets = LiteralSets(len(self.touched))

    def _spread(self, literals: Iterable[Literal]) -> None:
        """Adds what the literals may derive, and what may lose its derivation by them."""
        laws, possible = self._laws, self._possible
        queue = list(filter(possible.add, literals))
        while queue:
            name, row, positive = (it := queue.pop()).name, it.arguments, it.is_positive
            for pattern in laws.consequences.get((name, positive), ()):
                queue += filter(possible.add, pattern.heads(row, possible))
            for pattern in laws.grounds.get((name, not positive), ()):
                lost = (head.complement for head in pattern.heads(row, possible))
                queue += filter(possible.add, lost)

    @cached_property
    def instances(self) -> list[Constraint]:
        """Every instance of a constraint about a touched atom that may apply."""
        return [
            instance
            for atom in self.touched
            for positive in (True, False)
            for pattern in self._laws.supports.get((atom.name, positive), ())
            for instance in pattern.instances(atom.arguments, self._possible)
        ]

    @cached_property
    def _closure(self) -> Closure:
        rules = {(self._mask(i.body), self._bit(i.head)) for i in self.instances}
        return Closure(self._sets, sorted(rules))

    def outcomes(self) -> tuple[Mapping[Fluent, bool], ...]:
        """The values of the touched atoms in each outcome; none: the literals cannot be."""
        if not self.touched:
            return ({},)
        defaults = self._mask(
            atom
            if atom.name not in self._laws.defined
            and self._facts.may_hold(atom.name, atom.arguments)
            else atom.complement
            for atom in self.touched
        )
        models = self._closure.models(self._mask(self._given), defaults)
        return tuple(
            {atom: bool(model >> number & 1) for atom, number in self._numbers.items()}
            for model in models
        )

    def conflict(self) -> Constraint | None:
        """A constraint that the literals break together with what must follow from them alone."""
        known = set(self._given)
        before = -1
        while len(known) != before:
            before = len(known)
            known.update(i.head for i in self.instances if known.issuperset(i.body))
        broken = (i for i in self.instances if i.head.complement in known)
        return next((i for i in broken if known.issuperset(i.body)), None)

    def _mask(self, literals: Iterable[Literal]) -> int:
        """The touched ones among the literals; the others hold in every outcome."""
        mask = 0
        for literal in literals:
            if literal.atom in self._numbers:
                mask |= self._bit(literal)
        return mask

    def _bit(self, literal: Literal) -> int:
        return self._sets.literal(self._numbers[literal.atom], literal.is_positive)
