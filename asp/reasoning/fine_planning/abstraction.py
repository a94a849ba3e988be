"""Descriptions narrowed to some constants, named by position: what differs in names is equal."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass
from functools import cached_property
from itertools import product

from asp.language import Signature, arguments, ground, renamed, syntax
from asp.translation import BASE, OPEN, STATE, STEP, Rule, compact, plain


@dataclass(frozen=True)
class Narrow:
    """A narrowed description in canonical names.

    `sorts` are the members of each sort and `facts` the true statics that are stated; two
    descriptions with equal ones have the same transitions. `names` leads from the old names to
    the canonical ones.
    """

    sorts: tuple[tuple[str, tuple[str, ...]], ...]
    facts: frozenset[str]
    names: Mapping[str, str]

    @property
    def key(self) -> object:
        return self.sorts, self.facts

    @cached_property
    def _back(self) -> Mapping[str, str]:
        return {new: old for old, new in self.names.items()}

    def seen(self, literals: Iterable[str]) -> tuple[str, ...]:
        """Those of the literals that name nothing else, in canonical names."""
        return tuple(
            renamed(literal, self.names)
            for literal in literals
            if all(constant in self.names for constant in arguments(literal))
        )

    def back(self, actions: Iterable[str]) -> tuple[str, ...]:
        """Actions in the names of the description."""
        return tuple(renamed(action, self._back) for action in actions)


class Narrower:
    """Narrows one description; its laws are translated once. Raises NotCompactError."""

    def __init__(self, source: syntax.Source, signature: Signature) -> None:
        self._signature = signature
        self.rules = compact(source, signature)
        self._constants = tuple(dict.fromkeys(m for ms in signature.sorts.values() for m in ms))
        # What laws name keeps its name.
        self._fixed = frozenset(c for rule in self.rules for c in rule.constants)
        self._facts: dict[str, list[tuple[str, tuple[str, ...]]]] = defaultdict(list)
        for fact in source.each(syntax.Fact):
            arguments_ = tuple(term.name for term in fact.literal.atom.args)
            self._facts[arguments_[0] if arguments_ else ""].append(
                (fact.literal.atom.name, arguments_)
            )

    def narrow(self, constants: frozenset[str]) -> Narrow:
        """The description with these constants only."""
        kept = [c for c in self._constants if c in constants]
        names = {c: c if c in self._fixed else f"x{number}" for number, c in enumerate(kept)}
        sorts = tuple(
            (sort, tuple(names[m] for m in members if m in names))
            for sort, members in self._signature.sorts.items()
        )
        facts = frozenset(
            ground(static, (names[a] for a in args))
            for first in (*kept, "")
            for static, args in self._facts.get(first, ())
            if all(a in names for a in args)
        )
        return Narrow(sorts, facts, names)

    def program(self, narrow: Narrow) -> str:
        """The compact program of the narrowed description."""
        facts = [f"{sort}({member})." for sort, members in narrow.sorts for member in members]
        facts += (f"{fact}." for fact in sorted(narrow.facts))
        return "\n".join([self.worded(narrow, plain), f"#program {BASE}.", *facts])

    def worded(self, narrow: Narrow, wording: Callable[[Rule], Iterable[str]]) -> str:
        """The rules of the program, without what there is and what is stated of it."""
        parts: dict[str, list[str]] = {BASE: [], OPEN: [], STATE: [], STEP: []}
        for rule in self.kept(narrow):
            parts[rule.part] += wording(rule)
        parts[BASE] += (f"#defined {sort}/1." for sort, _ in narrow.sorts)
        for symbol in self._signature.symbols.values():
            if symbol.kind == "static":
                parts[BASE].append(f"#defined {symbol.name}/{len(symbol.sorts)}.")
        return "\n".join(f"#program {part}.\n" + "\n".join(lines) for part, lines in parts.items())

    def kept(self, narrow: Narrow) -> list[Rule]:
        """The rules that name nothing else."""
        return [rule for rule in self.rules if rule.constants <= narrow.names.keys()]

    def actions(self, narrow: Narrow) -> list[str]:
        """The agent actions in the order of declaration, in canonical names."""
        members = dict(narrow.sorts)
        return [
            ground(symbol.name, chosen)
            for symbol in self._signature.symbols.values()
            if symbol.kind == "agent"
            for chosen in product(*(members[sort.name] for sort in symbol.sorts))
        ]
