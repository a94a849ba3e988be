"""Descriptions in AL_d as data, and their text."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, replace
from functools import cached_property
from itertools import chain, product
from typing import NamedTuple, TypeAlias

EQUAL = "="
STATIC = "static"


class Atom(NamedTuple):
    """A name with constants and variables, positive or negative; or two terms that are compared."""

    name: str
    terms: tuple[str, ...] = ()
    positive: bool = True

    def __str__(self) -> str:
        if self.name == EQUAL:
            return f" {'' if self.positive else '!'}= ".join(self.terms)
        return f"{'' if self.positive else '-'}{_applied(self.name, ', ', self.terms)}"

    def bound(self, binding: Mapping[str, str]) -> Atom:
        """The atom with constants for its variables."""
        return self._replace(terms=tuple(binding.get(term, term) for term in self.terms))

    @property
    def ground(self) -> str:
        """The text as answer set programs have it, without blanks."""
        return f"{'' if self.positive else '-'}{_applied(self.name, ',', self.terms)}"


@dataclass(frozen=True)
class Symbol:
    """A declared static, fluent or action; `kind` is the word of its declaration."""

    kind: str
    name: str
    sorts: tuple[str, ...]


_FORMS = {
    "causes": ("laws", "{0} causes {1}"),
    "law": ("laws", "{0}"),
    "impossible": ("laws", "impossible {all}"),
    "fact": ("facts", "{0}"),
    "some": ("initially", "{0} for some {name}"),
    "default": ("defaults", "{name}: {0}"),
    "exception": ("defaults", "exception {name}"),
    "sees": ("sees", "{name} sees {0}"),
    "shows": ("shows", "{0} shows {1}"),
}


@dataclass(frozen=True)
class Statement:
    """A statement; `kind` is one of nine, `name` that of a default, a variable or a robot."""

    kind: str
    heads: tuple[Atom, ...]
    body: tuple[Atom, ...] = ()
    name: str = ""

    @property
    def names_a_constant(self) -> bool:
        """Whether an atom has a term that is no variable."""
        atoms = *self.heads, *self.body
        return any(not term[0].isupper() for atom in atoms for term in atom.terms)

    def __str__(self) -> str:
        heads = [*map(str, self.heads)]
        said = _FORMS[self.kind][1].format(*heads, all=", ".join(heads), name=self.name)
        return f"{said} if {', '.join(map(str, self.body))}." if self.body else f"{said}."


Parts: TypeAlias = tuple[str | tuple[str, ...], ...]
"""The parts of a sort: names of sorts, and tuples of constants."""


@dataclass(frozen=True)
class Description:
    """Sorts by name, symbols, and statements."""

    sorts: Mapping[str, Parts]
    symbols: tuple[Symbol, ...] = ()
    statements: tuple[Statement, ...] = ()

    def saying(self, more: Iterable[Statement]) -> Description:
        """The description with more statements."""
        return replace(self, statements=(*self.statements, *more))

    @property
    def schematic(self) -> Description:
        """The description without the statements that name a constant, but for robots that see."""
        said = (s for s in self.statements if not s.names_a_constant)
        return replace(self, statements=tuple(said))

    @cached_property
    def text(self) -> str:
        """The AL_d text."""
        sections: dict[str, list[str]] = {"sorts": [*map(self._sort, self.sorts)]}
        for symbol in self.symbols:
            declared = _applied(symbol.name, ", ", symbol.sorts)
            kind = "" if symbol.kind == STATIC else f"{symbol.kind} "
            sections.setdefault(_section(symbol.kind), []).append(f"{kind}{declared}.")
        for statement in self.statements:
            sections.setdefault(_FORMS[statement.kind][0], []).append(str(statement))
        return "".join(
            f"{section}\n" + "".join(f"  {line}\n" for line in lines)
            for section, lines in sections.items()
        )

    def members(self, sort: str) -> tuple[str, ...]:
        """The constants of a sort, in order."""
        parts = (self.members(p) if isinstance(p, str) else p for p in self.sorts[sort])
        return tuple(dict.fromkeys(chain.from_iterable(parts)))

    def atoms(self, kind: str) -> tuple[str, ...]:
        """The ground symbols of a kind, in the order of declaration."""
        return tuple(
            Atom(symbol.name, terms).ground
            for symbol in self.symbols
            if symbol.kind == kind
            for terms in product(*map(self.members, symbol.sorts))
        )

    def _sort(self, name: str) -> str:
        parts = (p if isinstance(p, str) else f"{{{', '.join(p)}}}" for p in self.sorts[name])
        return f"{name} = {' + '.join(parts)}."


def _section(kind: str) -> str:
    if kind == STATIC:
        return "statics"
    return "fluents" if kind in ("inertial", "defined") else "actions"


def _applied(name: str, separator: str, terms: Iterable[str]) -> str:
    inside = separator.join(terms)
    return f"{name}({inside})" if inside else name
