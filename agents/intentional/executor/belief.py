"""What the robot takes for certain at the fine resolution: the history H_f and what follows."""

from __future__ import annotations

from collections.abc import Collection, Iterable
from itertools import chain

from agents.intentional.executor.compiled import means_of
from asp.language import arguments, atom, complement
from asp.reasoning.fine_knowledge import Known
from asp.refinement import Refinement


class FineBelief:
    """What is known of a trial at the fine resolution.

    Inferences are those of `fine_inference.lp`; where the laws are simple,
    `asp.reasoning.fine_knowledge.incremental` makes them.
    """

    def __init__(self, refinement: Refinement, literals: Iterable[str]) -> None:
        """`literals` are known to begin with."""
        self._refinement = refinement
        means = means_of(refinement)
        self._quick, self._theory = means.quick, means.theory
        self._is_value = means.is_value
        self._plain, self._carriers = means.plain, means.carriers
        self._carrying: frozenset[str] = frozenset()
        self.known = Known()
        self.see(literals)

    def see(self, literals: Iterable[str]) -> None:
        """Takes literals for certain that were observed at one moment.

        What was known gives way to them; where that does not suffice, the least is forgotten.
        """
        seen, known = list(literals), self._with_carriers()
        after = self._quick.after(known, seen) if self._quick.is_enough else None
        after = after or self._theory.infer(known, [seen], ()).known
        self.known = Known(after.true - self._plain, after.false - self._plain)

    def suppose(self, plain: Collection[str]) -> None:
        """Goes by these fluents without counterparts: of those that matter here others are false.

        Where a thing is that has no components may follow from what carries it.
        """
        carrying = self._carriers.intersection(plain)
        if carrying != self._carrying:
            self._carrying = carrying
            self.see(())

    def _with_carriers(self) -> Known:
        """What is known, of the fluents without counterparts that it depends on, too."""
        known = self.known
        idle = self._carriers - self._carrying
        return Known(known.true | self._carrying, known.false | idle)

    def forget(self, literals: Iterable[str]) -> None:
        """Takes literals no longer for certain."""
        self.known = self.known.without(literals)

    def is_open(self, fluent: str) -> bool:
        """Whether it is not known if a fluent holds."""
        return fluent not in self.known.true and not self.is_false(fluent)

    def is_false(self, fluent: str) -> bool:
        """Whether a fluent is known not to hold."""
        if self._quick.is_enough:
            return self._quick.is_false(self.known, fluent)
        about = {self._refinement.wholes[part] for part in arguments(fluent)}
        inferred = self._theory.infer(self._with_carriers(), [], about)
        return fluent not in inferred.known.true and fluent not in inferred.possible

    def coarse(self, fluents: Collection[str]) -> frozenset[str]:
        """The literals that follow of coarse fluents with counterparts (indirect observation)."""
        if self._quick.is_enough:
            return self._quick.coarse(self.known, fluents)
        about = {constant for fluent in fluents for constant in arguments(fluent)}
        inferred = self._theory.infer(self._with_carriers(), [], about).coarse
        return frozenset(literal for literal in inferred if atom(literal) in fluents)

    def candidates(self, fluent: str) -> tuple[tuple[str, ...], ...]:
        """Groups of fluents one of each of which is true, nobody knows which, if a coarse one is.

        One group for each component that always has a value, as a thing is always somewhere; else
        a single one. None where one is known.
        """
        groups = self._quick.groups(fluent)
        if not self._is_value(groups[0][0]):
            groups = (tuple(chain(*groups)),)
        if any(not self.known.true.isdisjoint(group) for group in groups):
            return ()
        return tuple(tuple(f for f in group if not self.is_false(f)) for group in groups)

    def adapt(
        self, before: Collection[str], now: Collection[str], fluents: Collection[str]
    ) -> None:
        """Forgets what an explanation at the coarse resolution has made doubtful.

        `before` and `now` are the fluents that were expected and that are believed. Of what is now
        believed and was not expected, and of what is nowhere to be any more though it is believed,
        observations to the contrary are old.
        """
        follows = self.coarse(fluents)
        for fluent in fluents:
            literal = fluent if fluent in now else complement(fluent)
            changed = (fluent in before) != (fluent in now)
            if complement(literal) in follows or (changed and literal not in follows):
                groups = self._refinement.counterpart(literal)
                self.forget(complement(part) for group in groups for part in group)
