"""The inferences of `fine_inference.lp`, step by step and without a solver, where laws are simple.

Laws are simple if each of them is one of three: an exclusion (`-f(X, C2) if f(X, C1), C1 != C2`),
one by which all components of a whole share a fluent, or one that derives a fluent from others
that are true. Where observations contradict each other nothing is said here: which of them to
forget is left to the theory.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import replace
from functools import lru_cache
from itertools import product

from asp import roles, syntax
from asp.checker import variable_domains
from asp.knowing import Known
from asp.literals import arguments, atom, complement, ground, is_positive, name
from asp.refinement import Refinement
from asp.refinement.refining import shared_places
from asp.signature import Signature

_REMEMBERED = 50_000


class Quick:
    """What is known after observations, in a refinement; `is_enough` if its laws are simple."""

    def __init__(self, refinement: Refinement) -> None:
        self._refinement = refinement
        self._laws = _Laws(refinement.weak, refinement.weak_signature)
        self.is_enough = self._laws.are_simple
        remembering = lru_cache(_REMEMBERED)
        self._alike = remembering(self._find_alike)
        self._parts = remembering(self._find_parts)
        self.groups = remembering(self._find_groups)
        self._variables = remembering(self._find_variables)
        self._values = lru_cache(1)(self._find_values)

    def after(self, known: Known, seen: Iterable[str]) -> Known | None:
        """What is known after literals seen at one step; None: they contradict each other.

        What was known before gives way to what was seen, and to what follows from it.
        """
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
        if not known.false.isdisjoint(self._alike(fluent)):
            return True
        values = self._values(known.true)
        return any(values.get(key, own) != own for key, own in self._variables(fluent))

    def possible(self, known: Known, fluents: Iterable[str]) -> list[str]:
        """Those inertial fluents of which it is not known whether they are true."""
        return [f for f in fluents if f not in known.true and not self.is_false(known, f)]

    def coarse(self, known: Known, fluents: Iterable[str]) -> frozenset[str]:
        """What follows of coarse fluents that have counterparts, as literals."""
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


class _Laws:
    """Laws by their kind: exclusions, shared fluents, derivations; statics as facts."""

    def __init__(self, source: syntax.Source, signature: Signature) -> None:
        shared = shared_places(source)
        self.shared = dict(shared)
        self.single: dict[str, tuple[int, ...]] = {}
        self.are_simple = len(self.shared) == len(shared)
        self._derivations: list[_Derivation] = []
        self._facts = frozenset(
            ground(fact.literal.atom.name, (term.name for term in fact.literal.atom.args))
            for fact in source.each(syntax.Fact)
        )
        for law in source.each(syntax.StateConstraint):
            if signature.symbols[law.head.atom.name].kind == "inertial":
                self._take(law, source, signature)

    def derived(self, true: Iterable[str]) -> Iterator[str]:
        """What derivations conclude from fluents that are true."""
        by_name: dict[str, list[str]] = {}
        for fluent in true:
            by_name.setdefault(name(fluent), []).append(fluent)
        for derivation in self._derivations:
            yield from derivation.heads(by_name, self._facts)

    def _take(
        self, law: syntax.StateConstraint, source: syntax.Source, signature: Signature
    ) -> None:
        place = _excluded_place(law)
        if place is not None:
            fluent = law.head.atom.name
            self.single[fluent] = (*self.single.get(fluent, ()), place)
        elif not shared_places(replace(source, statements=(law,))):
            self.are_simple &= _is_derivation(law, source, signature)
            self._derivations.append(_Derivation(law, signature))


class _Derivation:
    """A law that derives its head from fluents that are true."""

    def __init__(self, law: syntax.StateConstraint, signature: Signature) -> None:
        literals = [p for p in roles.literals(law.body) if p.atom.name in signature.symbols]
        kinds = {p.atom.name: signature.symbols[p.atom.name].kind for p in literals}
        self._head = law.head.atom
        self._fluents = [p.atom for p in literals if kinds[p.atom.name] in roles.FLUENTS]
        self._statics = [p for p in literals if kinds[p.atom.name] == "static"]
        self._comparisons = list(roles.comparisons(law.body))
        domains = variable_domains(law, signature)
        self._domains = {variable: frozenset(members) for variable, members in domains.items()}

    def heads(self, true: Mapping[str, list[str]], facts: frozenset[str]) -> Iterator[str]:
        """The instances of the head whose conditions are met."""
        for chosen in product(*(true.get(fluent.name, []) for fluent in self._fluents)):
            binding = self._binding(chosen)
            if binding is not None and self._is_met(binding, facts):
                yield _instance(self._head, binding)

    def _binding(self, chosen: Iterable[str]) -> dict[str, str] | None:
        binding: dict[str, str] = {}
        for part, fluent in zip(self._fluents, chosen, strict=True):
            for term, value in zip(part.args, arguments(fluent), strict=True):
                expected = binding.setdefault(term.name, value) if term.is_variable else term.name
                if value != expected or value not in self._domains.get(term.name, (value,)):
                    return None
        return binding

    def _is_met(self, binding: Mapping[str, str], facts: frozenset[str]) -> bool:
        return all(
            (_instance(s.atom, binding) in facts) == s.positive for s in self._statics
        ) and all(
            (binding.get(c.left.name, c.left.name) == binding.get(c.right.name, c.right.name))
            == c.equal
            for c in self._comparisons
        )


def _excluded_place(law: syntax.StateConstraint) -> int | None:
    """The place in which a fluent has one value at most, if that is what the law says."""
    fluents, comparisons = list(roles.literals(law.body)), list(roles.comparisons(law.body))
    if law.head.positive or len(fluents) != 1 or len(comparisons) != 1 or comparisons[0].equal:
        return None
    own, other = law.head.atom, fluents[0].atom
    if own.name != other.name or not fluents[0].positive:
        return None
    differ = [
        n for n, (a, b) in enumerate(zip(own.args, other.args, strict=True)) if a.name != b.name
    ]
    compared = {comparisons[0].left.name, comparisons[0].right.name}
    if len(differ) != 1 or not all(term.is_variable for term in (*own.args, *other.args)):
        return None
    named = {own.args[differ[0]].name, other.args[differ[0]].name}
    distinct = len({term.name for term in own.args}) == len(own.args)
    return differ[0] if compared == named and distinct else None


def _is_derivation(
    law: syntax.StateConstraint, source: syntax.Source, signature: Signature
) -> bool:
    """Whether a law's fluents are positive and bind its variables, and its statics are facts."""
    literals = [p for p in roles.literals(law.body) if p.atom.name in signature.symbols]
    kinds = [signature.symbols[p.atom.name].kind for p in literals]
    fluents = [p for p, kind in zip(literals, kinds, strict=True) if kind != "static"]
    bound = {term.name for fluent in fluents for term in fluent.atom.args}
    derived = {other.head.atom.name for other in source.each(syntax.StateConstraint)}
    statics = {p.atom.name for p, kind in zip(literals, kinds, strict=True) if kind == "static"}
    return (
        law.head.positive
        and all(fluent.positive for fluent in fluents)
        and "defined" not in kinds
        and statics.isdisjoint(derived)
        and bound.issuperset(variable_domains(law, signature))
    )


def _instance(atom: syntax.Atom, binding: Mapping[str, str]) -> str:
    return ground(atom.name, (binding.get(term.name, term.name) for term in atom.args))


def _with(args: tuple[str, ...], place: int, value: str) -> tuple[str, ...]:
    return (*args[:place], value, *args[place + 1 :])
