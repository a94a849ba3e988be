"""Where the places of a domain lie, read off the statics of its description.

A place is a member of the sort over which a two-place static (an adjacency) ranges. Where another
static gives each member of one such sort a member of another, the former are cells of the latter,
and what else that static relates are components and their wholes. Else the places are those of the
adjacency that says most.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field
from itertools import permutations
from typing import TypeAlias

from asp.language import Description
from asp.language import literals as text

Pair: TypeAlias = tuple[str, str]
Adjacency: TypeAlias = Mapping[str, frozenset[str]]


@dataclass(frozen=True)
class Layout:
    """Places with their neighbours, in the order of declaration.

    At the fine resolution `cells` are those of each place, and `wholes` what each constant is a
    component of.
    """

    adjacent: Adjacency
    cells: Mapping[str, tuple[str, ...]] = field(default_factory=dict)
    wholes: Mapping[str, str] = field(default_factory=dict)

    def is_component(self, constant: str) -> bool:
        """Whether the constant is of the fine resolution only."""
        return self.wholes.get(constant, constant) != constant

    def walk(self) -> tuple[str, ...]:
        """The places in depth-first order, from a dead end if there is one."""
        seen: dict[str, None] = {}
        stack = sorted(self.adjacent, key=lambda place: len(self.adjacent[place]) != 1)[::-1]
        while stack:
            place = stack.pop()
            if place not in seen:
                seen[place] = None
                neighbours = self.adjacent[place]
                stack += [other for other in reversed(list(self.adjacent)) if other in neighbours]
        return tuple(seen)


def layout(description: Description) -> Layout:
    """The layout of a domain; no places at all where nothing is adjacent."""
    named: dict[str, list[Pair]] = {}
    for static in sorted(description.statics):
        named.setdefault(text.name(static), []).extend(pairs([static]))
    spaces = {name: _places(found, description) for name, found in named.items()}
    for fine, coarse in permutations((name for name in spaces if spaces[name]), 2):
        for relation, related in named.items():
            cells = _cells(dict(related), spaces[fine], spaces[coarse])
            if cells and relation not in (fine, coarse):
                return Layout(_neighbours(spaces[coarse], named[coarse]), cells, dict(related))
    widest = max(named, key=lambda name: len(named[name]) if spaces[name] else -1, default="")
    return Layout(_neighbours(spaces.get(widest, ()), named.get(widest, [])))


def pairs(atoms: Iterable[str]) -> list[Pair]:
    """The arguments of the two-place atoms."""
    found = (text.arguments(atom) for atom in atoms)
    return [(args[0], args[1]) for args in found if len(args) == 2]


def _places(found: list[Pair], description: Description) -> tuple[str, ...]:
    """The smallest sort that has all the constants of the pairs."""
    joined = {constant for pair in found for constant in pair}
    sorts = [members for members in description.sorts.values() if joined <= set(members)]
    return min(sorts, key=len) if joined and sorts else ()


def _cells(
    wholes: Mapping[str, str], fine: tuple[str, ...], coarse: tuple[str, ...]
) -> dict[str, tuple[str, ...]]:
    """The cells of each place; none if a cell has no place."""
    if not set(coarse).issuperset(wholes.get(cell, "") for cell in fine):
        return {}
    return {place: tuple(cell for cell in fine if wholes[cell] == place) for place in coarse}


def _neighbours(places: tuple[str, ...], found: list[Pair]) -> Adjacency:
    return {
        place: frozenset({b for a, b in found if a == place} | {a for a, b in found if b == place})
        for place in places
    }
