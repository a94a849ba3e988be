"""Whether the fine map fits the coarse one, so that every coarse action can be carried out.

A map is a static with a counterpart that an action needs: it stands negated in an executability
condition, as `next_to` does where nothing moves between places that are not next to each other.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass

from asp.language import Literal, Problems, syntax
from asp.language import variable_sorts as roles
from asp.refinement.language import Components, Magnification
from asp.refinement.vocabulary import Vocabulary

Pairs = frozenset[tuple[str, str]]


def check_maps(
    fine: syntax.Source,
    coarse: syntax.Source,
    vocabulary: Vocabulary,
    statics: frozenset[Literal],
    problems: Problems,
) -> None:
    """Reports where a fine map does not fit the coarse one, at a place of the refinement's text."""
    places = _Places(fine)
    for way in _ways(coarse, vocabulary):
        fitting = _Map(way, vocabulary, _pairs(way, statics))
        finer = _pairs(vocabulary.counterparts[way], statics)
        for place, message in (
            *fitting.missing(places),
            *fitting.unreachable(finer, places),
            *fitting.cut_off(places),
            *fitting.unconnected(finer, places),
            *fitting.too_many(finer, places),
        ):
            problems.report(place, message)


def _ways(coarse: syntax.Source, vocabulary: Vocabulary) -> list[str]:
    """The statics of two magnified places that an action with a counterpart needs."""
    found = (
        literal.atom.name
        for law in coarse.each(syntax.ExecutabilityCondition)
        if any(action.name in vocabulary.counterparts for action in law.actions)
        for literal in roles.literals(law.body)
        if not literal.positive and _is_way(literal.atom.name, vocabulary)
    )
    return list(dict.fromkeys(found))


def _is_way(symbol: str, vocabulary: Vocabulary) -> bool:
    if symbol not in vocabulary.counterparts:
        return False
    declaration = vocabulary.coarse.symbols[symbol]
    touched = [vocabulary.touches(sort.name) for sort in declaration.sorts]
    return declaration.kind == "static" and touched == [True, True]


def _pairs(static: str, statics: Iterable[Literal]) -> Pairs:
    return frozenset((s.arguments[0], s.arguments[1]) for s in statics if s.name == static)


class _Places:
    """Where a refinement's text speaks of a constant, or of two at once."""

    def __init__(self, fine: syntax.Source) -> None:
        self._fine = fine
        self._listed = {s.whole.name: s.place for s in fine.each(Components)}
        self._parts = {p.name: p.place for s in fine.each(Components) for p in s.parts}
        self.named = {t.name for fact in fine.each(syntax.Fact) for t in fact.literal.atom.args}

    def of(self, constant: str) -> syntax.Place:
        found = self._parts.get(constant) or self._listed.get(constant)
        return found or next(self._fine.each(Magnification)).place

    def of_fact(self, static: str, *constants: str) -> syntax.Place | None:
        """The place of the fact, if it is one of the text's."""
        for fact in self._fine.each(syntax.Fact):
            atom = fact.literal.atom
            if atom.name == static and tuple(term.name for term in atom.args) == constants:
                return fact.place
        return None


Found = Iterator[tuple[syntax.Place, str]]


@dataclass(frozen=True)
class _Map:
    """A coarse map, and what has to be so in a fine one."""

    static: str
    vocabulary: Vocabulary
    coarse: Pairs

    @property
    def _counterpart(self) -> str:
        return self.vocabulary.counterparts[self.static]

    def _wholes(self) -> list[str]:
        sorts = self.vocabulary.coarse.symbols[self.static].sorts
        members = (member for s in sorts for member in self.vocabulary.coarse.sorts[s.name])
        return list(dict.fromkeys(members))

    def missing(self, places: _Places) -> Found:
        """A place without components that no fact connects to a component of another."""
        for whole in self._lost(places):
            yield places.of(whole), f"'{whole}' has no components, and no fact speaks of it"

    def _lost(self, places: _Places) -> set[str]:
        components = self.vocabulary.components
        return {
            whole
            for whole in self._wholes()
            if components[whole] == (whole,) and whole not in places.named
        }

    def unreachable(self, finer: Pairs, places: _Places) -> Found:
        """From each component of a whole one gets to each other without leaving the whole."""
        back = frozenset((other, one) for one, other in finer)
        for whole in self._wholes():
            first, *others = self.vocabulary.components[whole]
            there, and_back = (_reached(first, {first, *others}, way) for way in (finer, back))
            for part in others:
                if part not in there & and_back:
                    one, other = (part, first) if part not in there else (first, part)
                    message = f"'{one}' cannot be reached from '{other}' inside '{whole}'"
                    yield places.of(part), message

    def cut_off(self, places: _Places) -> Found:
        """From each whole one gets to each other, so that nobody is caught in one."""
        first, *others = self._wholes()
        back = frozenset((other, one) for one, other in self.coarse)
        there, and_back = (_reached(first, {first, *others}, way) for way in (self.coarse, back))
        for whole in others:
            if whole not in there & and_back and whole not in self._lost(places):
                one, other = (whole, first) if whole not in there else (first, whole)
                message = f"'{one}' cannot be reached from '{other}' by {self.static}"
                yield places.of(whole), message

    def unconnected(self, finer: Pairs, places: _Places) -> Found:
        """Where the coarse map has a way there is one between components."""
        owner, lost = self._owner(), self._lost(places)
        ways = {(owner[one], owner[other]) for one, other in finer}
        missing = {(a, b) for a, b in self.coarse - ways if a != b and not lost & {a, b}}
        for one, other in _once(missing, self._wholes()):
            yield (
                places.of(one),
                f"{self.static}({one}, {other}), but no component of '{one}' is "
                f"{self._counterpart} to one of '{other}'",
            )

    def too_many(self, finer: Pairs, places: _Places) -> Found:
        """A way between components of two wholes that have none between them."""
        owner, static = self._owner(), self._counterpart
        crossing = {(a, b): (owner[a], owner[b]) for a, b in finer if owner[a] != owner[b]}
        wrong = {pair for pair, wholes in crossing.items() if wholes not in self.coarse}
        stated = [pair for pair in sorted(wrong) if places.of_fact(static, *pair)]
        order = [part for pair in stated for part in pair] + sorted(owner)
        for one, other in _once(wrong, order):
            whole, beyond = crossing[one, other]
            yield (
                places.of_fact(static, one, other) or places.of(one),
                f"{static}({one}, {other}) leads from '{whole}' to '{beyond}', "
                f"but {self.static}({whole}, {beyond}) does not hold",
            )

    def _owner(self) -> Mapping[str, str]:
        components = self.vocabulary.components
        return {part: whole for whole in self._wholes() for part in components[whole]}


def _once(pairs: set[tuple[str, str]], order: list[str]) -> list[tuple[str, str]]:
    """The pairs in this order of their members, one of two that are each other turned round."""
    rank = {name: number for number, name in reversed(list(enumerate(order)))}
    ordered = sorted(pairs, key=lambda pair: (rank[pair[0]], rank[pair[1]]))
    return [(a, b) for a, b in ordered if (b, a) not in pairs or rank[a] < rank[b]]


def _reached(start: str, inside: set[str], steps: Pairs) -> set[str]:
    found = {start}
    stack = [start]
    onward: dict[str, list[str]] = {}
    for one, other in steps:
        if one in inside and other in inside:
            onward.setdefault(one, []).append(other)
    while stack:
        for other in onward.get(stack.pop(), ()):
            if other not in found:
                found.add(other)
                stack.append(other)
    return found
