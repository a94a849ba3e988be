"""What a set of literals makes of a state: the small problem of the atoms that may change.

Of a state that is closed under the constraints nothing changes but what the new literals reach.
`touched` is a superset of that: it is closed under every constraint that fires when the new
literals, everything they may derive, and everything that was true are all taken for possible, and
under the loss of whatever a defined fluent may have been derived from. A defined fluent that may
fall by its own falling alone (`Laws.wavering`) is taken for possibly false from the start. All
other atoms keep their value in every outcome, so that they can be evaluated away, and the
outcomes are the models of a problem over the touched atoms alone, which the closure of ground
rules finds as in a small world.
"""

from __future__ import annotations

from collections.abc import Collection, Iterable, Mapping
from functools import cached_property, partial

from testbed.world.closure import Closure, LiteralSets, Rule
from testbed.world.matched.facts import (
    Facts,
    GroundAtom,
    GroundLiteral,
    Possibilities,
)
from testbed.world.matched.laws import Instance, Laws


class Change:
    """The outcomes of making `literals` true in `facts`.

    Where nothing is closed yet (a state that is being described), `seeds` are literals that the
    constraints add to the facts by themselves.
    """

    def __init__(
        self,
        laws: Laws,
        defined: Collection[str],
        facts: Facts,
        literals: Iterable[GroundLiteral],
        seeds: Iterable[GroundLiteral] = (),
    ) -> None:
        self._laws, self._defined, self._facts = laws, defined, facts
        self._given = tuple(literals)
        self._possible = Possibilities(facts)
        falling = ((atom, False) for name in laws.wavering for atom in facts.named(name))
        self._spread([*self._given, *seeds, *falling])
        self.touched = self._possible.touched
        self._numbers = {atom: number for number, atom in enumerate(self.touched)}
        self._sets = LiteralSets(len(self.touched))

    def _spread(self, literals: Iterable[GroundLiteral]) -> None:
        """Adds what the literals may derive, and what may lose its derivation by them."""
        queue = [literal for literal in literals if self._possible.add(literal)]

        def add(positive: bool, head: GroundAtom) -> None:
            if self._possible.add((head, positive)):
                queue.append((head, positive))

        while queue:
            atom, positive = queue.pop()
            for sign, pattern in self._laws.consequences.get((atom[0], positive), ()):
                pattern.search_heads([atom], self._possible, partial(add, sign))
            for pattern in self._laws.grounds.get((atom[0], not positive), ()):
                pattern.search_heads([atom], self._possible, partial(add, False))

    @cached_property
    def instances(self) -> list[Instance]:
        """Every instance of a constraint about a touched atom that may apply."""
        found: list[Instance] = []

        def keep(instance: Instance) -> bool:
            found.append(instance)
            return False

        for atom in self.touched:
            for positive in (True, False):
                for pattern in self._laws.supports.get((atom[0], positive), ()):
                    pattern.search([atom], self._possible, keep)
        return found

    @cached_property
    def _closure(self) -> Closure:
        rules = {
            (self._mask(instance.body), self._bit(instance.head)) for instance in self.instances
        }
        return Closure(self._sets, [Rule(body, head) for body, head in sorted(rules)])

    def outcomes(self) -> tuple[Mapping[GroundAtom, bool], ...]:
        """The values of the touched atoms in each outcome; none: the literals cannot be."""
        if not self.touched:
            return ({},)
        defaults = self._mask(
            (atom, atom[0] not in self._defined and self._facts.may_hold(atom))
            for atom in self.touched
        )
        models = self._closure.models(self._mask(self._given), defaults)
        return tuple(
            {atom: bool(model >> number & 1) for atom, number in self._numbers.items()}
            for model in models
        )

    def conflict(self) -> Instance | None:
        """A constraint that the literals break together with what must follow from them alone."""
        known = set(self._given)
        before = -1
        while len(known) != before:
            before = len(known)
            known.update(i.head for i in self.instances if known.issuperset(i.body))
        for instance in self.instances:
            atom, positive = instance.head
            if (atom, not positive) in known and known.issuperset(instance.body):
                return instance
        return None

    def _mask(self, literals: Iterable[GroundLiteral]) -> int:
        """The touched ones among the literals; the others hold in every outcome."""
        mask = 0
        for literal in literals:
            if literal[0] in self._numbers:
                mask |= self._bit(literal)
        return mask

    def _bit(self, literal: GroundLiteral) -> int:
        return self._sets.literal(self._numbers[literal[0]], literal[1])
