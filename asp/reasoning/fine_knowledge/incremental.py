"""The inferences of `fine_inference.lp`, step by step and without a solver, where laws are simple.

Laws are simple if each of them is one of three: an exclusion (`-f(X, C2) if f(X, C1), C1 != C2`),
one by which all components of a whole share a fluent, or one that derives a fluent from others
that are true. Where observations contradict each other nothing is said here: which of them to
forget is left to the theory.
"""

from __future__ import annotations

from collections.abc import Collection, Iterable, Mapping
from functools import lru_cache

from asp.language import arguments, atom, complement, ground, is_positive, name
from asp.reasoning.fine_knowledge.reference import Known, ReferenceFineKnowledge
from asp.reasoning.fine_knowledge.simple_laws import SimpleLaws
from asp.refinement import Refinement

_REMEMBERED = 50_000


class IncrementalFineKnowledge:
    """`FineKnowledge` without a solver where laws are simple (`is_simple`), else by the theory."""

    def __init__(self, refinement: Refinement) -> None:
        self._refinement = refinement
        self._theory = ReferenceFineKnowledge(refinement)
        self._laws = SimpleLaws(refinement.weak, refinement.weak_signature)
        self.is_simple = self._laws.are_simple
        remembering = lru_cache(_REMEMBERED)
        self._alike = remembering(self._find_alike)
        self._parts = remembering(self._find_parts)
        self.groups = remembering(self._find_groups)
        self._variables = remembering(self._find_variables)
        self._values = lru_cache(1)(self._find_values)

    def after(self, known: Known, seen: Collection[str]) -> Known:
        """What is known after literals seen at one step.

        Raises ValueError if they contradict each other.
        """
        following = self.following(known, seen) if self.is_simple else None
        return self._theory.after(known, seen) if following is None else following

    def following(self, known: Known, seen: Iterable[str]) -> Known | None:
        """What is known after literals seen at one step; None: they contradict each other."""
        literals = list(seen)
        told = [literal for literal in literals if is_positive(literal)]
        denied = {atom(literal) for literal in literals if not is_positive(literal)}
        impossible = {other for fluent in denied for other in self._alike(fluent)}
        old = set(known.true)
        true = self._closed({*told, *old})
        while lost := old & impossible | self._excluded(true - old, old):
            old -= lost
            true = self._closed({*told, *old})
        lost = set(known.true - old)
        contradictory = true & impossible or self._excluded(true, true)
        if contradictory or lost != lost & impossible | self._excluded(true, lost):
            return None
        return Known(frozenset(true), (known.false | denied) - true)

    def is_false(self, known: Known, fluent: str) -> bool:
        """Whether an inertial fluent is known to be false."""
        if not self.is_simple:
            return self._theory.is_false(known, fluent)
        if not known.false.isdisjoint(self._alike(fluent)):
            return True
        values = self._values(known.true)
        return any(values.get(key, own) != own for key, own in self._variables(fluent))

    def coarse(self, known: Known, fluents: Collection[str]) -> frozenset[str]:
        """What follows of coarse fluents that have counterparts, as literals."""
        if not self.is_simple:
            return self._theory.coarse(known, fluents)
        true = {coarse for fluent in known.true for coarse in self._refinement.coarse_of(fluent)}
        return frozenset(
            fluent if fluent in true else complement(fluent)
            for fluent in fluents
            if fluent in true or all(self.is_false(known, part) for part in self._parts(fluent))
        )

    def _find_groups(self, coarse: str) -> tuple[tuple[str, ...], ...]:
        """The fluents that make a coarse one true, by what they are values of.

        That is a fluent without the places in which it has one value at most.
        """
        groups: dict[tuple[str, ...], list[str]] = {}
        for (fluent,) in self._refinement.counterpart(coarse):
            places = self._laws.single.get(name(fluent), ())
            rest = (arg for place, arg in enumerate(arguments(fluent)) if place not in places)
            groups.setdefault(tuple(rest), []).append(fluent)
        return tuple(map(tuple, groups.values()))

    def _find_alike(self, fluent: str) -> tuple[str, ...]:
        """The fluents that are true exactly if this one is: those of other components."""
        place = self._laws.shared.get(name(fluent))
        if place is None:
            return (fluent,)
        args = arguments(fluent)
        others = self._refinement.components[self._refinement.wholes[args[place]]]
        return tuple(ground(name(fluent), _with(args, place, other)) for other in others)

    def _find_parts(self, coarse: str) -> tuple[str, ...]:
        """The fluents all of which are false exactly if a coarse one is; one of those alike."""
        groups = self._refinement.counterpart(coarse)
        return tuple(dict.fromkeys(self._alike(part)[0] for group in groups for part in group))

    def _find_variables(self, fluent: str) -> tuple[tuple[tuple[str, ...], str], ...]:
        """For each place in which a fluent has one value at most: the rest of it, the value."""
        args = arguments(fluent)
        return tuple(
            ((name(fluent), str(place), *_with(args, place, "")), args[place])
            for place in self._laws.single.get(name(fluent), ())
        )

    def _find_values(self, true: frozenset[str]) -> Mapping[tuple[str, ...], str]:
        return {key: value for fluent in true for key, value in self._variables(fluent)}

    def _excluded(self, true: Iterable[str], fluents: Iterable[str]) -> set[str]:
        """Those of the fluents whose place is taken by something that is true."""
        values: dict[tuple[str, ...], set[str]] = {}
        for fluent in true:
            for key, value in self._variables(fluent):
                values.setdefault(key, set()).add(value)
        return {
            fluent
            for fluent in fluents
            if any(values.get(key, set()) - {own} for key, own in self._variables(fluent))
        }

    def _closed(self, fluents: Iterable[str]) -> set[str]:
        """The fluents with all that follows from them and is true."""
        found: set[str] = set()
        new = {other for fluent in fluents for other in self._alike(fluent)}
        while not new <= found:
            found |= new
            new = {f for head in self._laws.derived(found) for f in self._alike(head)}
        return found


def _with(args: tuple[str, ...], place: int, value: str) -> tuple[str, ...]:
    return (*args[:place], value, *args[place + 1 :])
