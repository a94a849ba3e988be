"""The ground facts of a description, found by their constants."""

from __future__ import annotations

from collections.abc import Collection, Iterator
from dataclasses import replace

from asp.language import syntax


class Facts:
    """A source cut in two: `rules` is the source without its ground facts."""

    def __init__(self, source: syntax.Source) -> None:
        self._by_constant: dict[str, list[tuple[syntax.Fact, frozenset[str]]]] = {}
        rules = []
        for statement in source.statements:
            if isinstance(statement, syntax.Fact) and _is_ground(statement):
                names = [term.name for term in statement.literal.atom.args]
                self._by_constant.setdefault(names[0], []).append((statement, frozenset(names)))
            else:
                rules.append(statement)
        self.rules = replace(source, statements=tuple(rules))

    def about(self, constants: Collection[str]) -> Iterator[syntax.Fact]:
        """The facts all whose constants are among these."""
        known = frozenset(constants)
        for constant in known:
            for fact, names in self._by_constant.get(constant, ()):
                if names <= known:
                    yield fact


def _is_ground(fact: syntax.Fact) -> bool:
    terms = fact.literal.atom.args
    return bool(terms) and not any(term.is_variable for term in terms)
