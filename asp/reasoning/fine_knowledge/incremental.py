"""The inferences of `fine_inference.lp`, step by step and without a solver, where laws are simple.

Laws are simple if each of them is one of three: an exclusion (`-f(X, C2) if f(X, C1), C1 != C2`),
one by which all components of a whole share a fluent, or one that derives a fluent from others
that are true. Where observations contradict each other nothing is said here: which of them to
forget is left to the theory.
"""

from collections import defaultdict
from collections.abc import Collection, Iterable, Mapping
from dataclasses import replace
from functools import lru_cache

from asp.language import (
    Facts,
    Fluent,
    Literal,
    Pattern,
    closed_world,
    excluding_place,
    pattern_of,
    syntax,
)
from asp.language import variable_sorts as roles
from asp.reasoning.fine_knowledge.reference import Known, ReferenceFineKnowledge
from asp.refinement import Refinement, shared_places

_REMEMBERED = 50_000


class SimpleLaws:
    """Laws by their kind: exclusions, shared fluents, derivations.

    `single` are the places, by the name of a fluent, in which it has one value at most; `shared` is
    the place of the components that share it.
    """

    def __init__(self, refinement: Refinement) -> None:
        source, signature = refinement.weak, refinement.weak_signature
        kinds = {name: symbol.kind for name, symbol in signature.symbols.items()}
        statics = closed_world(refinement.statics, signature)
        shared = shared_places(source)
        self.shared = dict(shared)
        self.single: dict[str, list[int]] = defaultdict(list)
        self.are_simple = len(self.shared) == len(shared)
        self._derivations: list[Pattern] = []
        for law in source.each(syntax.StateConstraint):
            place = excluding_place(law)
            if kinds[law.head.atom.name] != "inertial":
                continue
            if place is not None:
                self.single[law.head.atom.name].append(place)
            elif not shared_places(replace(source, statements=(law,))):
                literals = [law.head, *roles.literals(law.body)]
                fluents = [p for p in literals if kinds.get(p.atom.name) in roles.FLUENTS]
                inertial = all(p.positive and kinds[p.atom.name] == "inertial" for p in fluents)
                self.are_simple &= inertial and len(fluents) > 2  # one speaks the other way, too
                self._derivations.append(pattern_of(law, signature, statics, head=law.head))

    def derived(self, true: Iterable[Fluent]) -> set[Fluent]:
        """What derivations conclude from fluents that are true."""
        facts = Facts(true)
        return {head for law in self._derivations for head in law.heads((), facts)}


class IncrementalFineKnowledge:
    """`FineKnowledge` without a solver where laws are simple (`is_simple`), else by the theory."""

    def __init__(self, refinement: Refinement) -> None:
        self._refinement = refinement
        self._theory = ReferenceFineKnowledge(refinement)
        self._laws = SimpleLaws(refinement)
        self.is_simple = self._laws.are_simple
        remembering = lru_cache(_REMEMBERED)
        self._alike = remembering(self._find_alike)
        self._parts = remembering(self._find_parts)
        self.groups = remembering(self._find_groups)
        self._variables = remembering(self._find_variables)
        self._values = lru_cache(1)(self._find_values)

    def after(self, known: Known, seen: Collection[Literal]) -> Known:
        """What is known after literals seen at one step.

        Raises ValueError if they contradict each other.
        """
        following = self.following(known, seen) if self.is_simple else None
        return self._theory.after(known, seen) if following is None else following

    def following(self, known: Known, seen: Iterable[Literal]) -> Known | None:
        """What is known after literals seen at one step; None: they contradict each other."""
        literals = list(map(Literal.parse, seen))
        told = {literal for literal in literals if literal.is_positive}
        denied = {literal.atom for literal in literals if not literal.is_positive}
        impossible = {other for fluent in denied for other in self._alike(fluent)}
        before = set(map(Literal.parse, known.true))
        old = before.copy()
        true = self._closed(told | old)
        while lost := old & impossible | self._excluded(true - old, old):
            old -= lost
            true = self._closed(told | old)
        lost = before - old
        contradictory = true & impossible or self._excluded(true, true)
        if contradictory or lost != lost & impossible | self._excluded(true, lost):
            return None
        return Known(frozenset(true), (known.false | denied) - true)

    def is_false(self, known: Known, fluent: Fluent) -> bool:
        """Whether an inertial fluent is known to be false."""
        if not self.is_simple:
            return self._theory.is_false(known, fluent)
        if not known.false.isdisjoint(self._alike(fluent)):
            return True
        values = self._values(known.true)
        return any(values.get(key, own) != own for key, own in self._variables(fluent))

    def coarse(self, known: Known, fluents: Collection[Fluent]) -> frozenset[Literal]:
        """What follows of coarse fluents that have counterparts, as literals."""
        if not self.is_simple:
            return self._theory.coarse(known, fluents)
        true = {coarse for fluent in known.true for coarse in self._refinement.coarse_of(fluent)}
        return frozenset(
            fluent if fluent in true else fluent.complement
            for fluent in map(Literal.parse, fluents)
            if fluent in true or all(self.is_false(known, part) for part in self._parts(fluent))
        )

    def _find_groups(self, coarse: Fluent) -> tuple[tuple[Fluent, ...], ...]:
        """The fluents that make a coarse one true, by what they are values of.

        That is a fluent without the places in which it has one value at most.
        """
        groups: dict[tuple[str, ...], list[Fluent]] = {}
        for (fluent,) in self._refinement.counterpart(coarse):
            places = self._laws.single.get(fluent.name, ())
            rest = (arg for place, arg in enumerate(fluent.arguments) if place not in places)
            groups.setdefault(tuple(rest), []).append(fluent)
        return tuple(map(tuple, groups.values()))

    def _find_alike(self, fluent: Fluent) -> tuple[Fluent, ...]:
        """The fluents that are true exactly if this one is: those of other components."""
        one = Literal.parse(fluent)
        place = self._laws.shared.get(one.name)
        if place is None:
            return (one,)
        others = self._refinement.components[self._refinement.wholes[one.arguments[place]]]
        return tuple(Literal.of(one.name, _with(one.arguments, place, other)) for other in others)

    def _find_parts(self, coarse: Fluent) -> tuple[Fluent, ...]:
        """The fluents all of which are false exactly if a coarse one is; one of those alike."""
        groups = self._refinement.counterpart(coarse)
        return tuple(dict.fromkeys(self._alike(part)[0] for group in groups for part in group))

    def _find_variables(self, fluent: Fluent) -> tuple[tuple[tuple[str, ...], str], ...]:
        """For each place in which a fluent has one value at most: the rest of it, the value."""
        one = Literal.parse(fluent)
        return tuple(
            ((one.name, str(place), *_with(one.arguments, place, "")), one.arguments[place])
            for place in self._laws.single.get(one.name, ())
        )

    def _find_values(self, true: frozenset[Fluent]) -> Mapping[tuple[str, ...], str]:
        return {key: value for fluent in true for key, value in self._variables(fluent)}

    def _excluded(self, true: Iterable[Fluent], fluents: Iterable[Fluent]) -> set[Fluent]:
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

    def _closed(self, fluents: Iterable[Fluent]) -> set[Fluent]:
        """The fluents with all that follows from them and is true."""
        found: set[Fluent] = set()
        new = {other for fluent in fluents for other in self._alike(fluent)}
        while not new <= found:
            found |= new
            new = {other for head in self._laws.derived(found) for other in self._alike(head)}
        return found


def _with(args: tuple[str, ...], place: int, value: str) -> tuple[str, ...]:
    return (*args[:place], value, *args[place + 1 :])
