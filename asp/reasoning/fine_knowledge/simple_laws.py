"""The simple laws of a description by their kind: exclusions, shared fluents, derivations."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import replace
from itertools import product

from asp.language import (
    Signature,
    arguments,
    excluding_place,
    ground,
    name,
    syntax,
    variable_domains,
)
from asp.language import variable_sorts as roles
from asp.refinement import shared_places


class SimpleLaws:
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
        place = excluding_place(law)
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
