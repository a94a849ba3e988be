"""Ground atoms, and where to find those with a given value at a given place.

An atom is a tuple of its name and its constants: `("loc", "book1", "kitchen")`.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import Protocol, TypeAlias

from asp.language import Literal

GroundAtom: TypeAlias = tuple[str, ...]
GroundLiteral: TypeAlias = tuple[GroundAtom, bool]
"""An atom, and whether it is true."""


class Truth(Protocol):
    """What may be true and what may be false, as far as a law asks for it."""

    def may_hold(self, atom: GroundAtom) -> bool: ...

    def may_fail(self, atom: GroundAtom) -> bool: ...

    def named(self, name: str) -> Sequence[GroundAtom]:
        """The atoms of a name that may be true."""

    def having(self, name: str, place: int, value: str) -> Sequence[GroundAtom]:
        """Those of them that have the value at the place, counted from 1."""


class Facts:
    """A set of true atoms; all others are false. An index is built when it is first asked for."""

    def __init__(self, atoms: Iterable[GroundAtom]) -> None:
        self._atoms = frozenset(atoms)
        self._by_name: dict[str, list[GroundAtom]] = {}
        for atom in sorted(self._atoms):
            self._by_name.setdefault(atom[0], []).append(atom)
        self._indices: dict[tuple[str, int], dict[str, list[GroundAtom]]] = {}

    def may_hold(self, atom: GroundAtom) -> bool:
        return atom in self._atoms

    def may_fail(self, atom: GroundAtom) -> bool:
        return atom not in self._atoms

    def named(self, name: str) -> Sequence[GroundAtom]:
        return self._by_name.get(name, ())

    def having(self, name: str, place: int, value: str) -> Sequence[GroundAtom]:
        index = self._indices.get((name, place))
        if index is None:
            index = self._indices[name, place] = {}
            for atom in self._by_name.get(name, ()):
                index.setdefault(atom[place], []).append(atom)
        return index.get(value, ())


class Possibilities:
    """Facts, and literals that may hold beside or instead of them."""

    def __init__(self, facts: Facts) -> None:
        self._facts = facts
        self._true: dict[str, list[GroundAtom]] = {}
        self.touched: dict[GroundAtom, bool] = {}
        """The atoms that may change, in the order found, each with the value it may get."""

    def add(self, literal: GroundLiteral) -> bool:
        """Whether the literal is new, being neither a fact nor already possible."""
        atom, positive = literal
        if self._facts.may_hold(atom) == positive or atom in self.touched:
            return False
        self.touched[atom] = positive
        if positive:
            self._true.setdefault(atom[0], []).append(atom)
        return True

    def may_hold(self, atom: GroundAtom) -> bool:
        return atom in self.touched or self._facts.may_hold(atom)

    def may_fail(self, atom: GroundAtom) -> bool:
        return atom in self.touched or self._facts.may_fail(atom)

    def named(self, name: str) -> Sequence[GroundAtom]:
        known, new = self._facts.named(name), self._true.get(name)
        return [*known, *new] if new else known

    def having(self, name: str, place: int, value: str) -> Sequence[GroundAtom]:
        known, new = self._facts.having(name, place, value), self._true.get(name)
        return [*known, *(atom for atom in new if atom[place] == value)] if new else known


def atom_of(literal: str) -> GroundAtom:
    """The atom of a fluent or an action. Raises ValueError for what is no literal."""
    read = Literal.parse(literal)
    return (read.name, *read.arguments)


def literal_of(literal: GroundLiteral) -> Literal:
    atom, positive = literal
    return Literal.of(atom[0], atom[1:], positive)
