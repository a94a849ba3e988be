"""Parts of a compact description, named by position: parts that differ in names only are equal."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Callable, Iterable, Mapping, Sequence
from functools import cached_property
from itertools import product

from asp.language import Signature, arguments, ground, renamed, syntax
from asp.translation import Part, Rule, compact


class CompactDescription:
    """A description whose laws are translated once. Raises NotCompactError."""

    def __init__(self, source: syntax.Source, signature: Signature) -> None:
        self.signature = signature
        self.rules = compact(source, signature)
        self._constants = tuple(dict.fromkeys(m for ms in signature.sorts.values() for m in ms))
        # What laws name keeps its name.
        self._fixed = frozenset(c for rule in self.rules for c in rule.constants)
        self._facts: dict[str, list[tuple[str, tuple[str, ...]]]] = defaultdict(list)
        for fact in source.each(syntax.Fact):
            terms = tuple(term.name for term in fact.literal.atom.args)
            self._facts[terms[0] if terms else ""].append((fact.literal.atom.name, terms))

    def part(self, constants: frozenset[str]) -> CompactPart:
        """The description with these constants only."""
        kept = [c for c in self._constants if c in constants]
        names = {c: c if c in self._fixed else f"x{number}" for number, c in enumerate(kept)}
        sorts = tuple(
            (sort, tuple(names[m] for m in members if m in names))
            for sort, members in self.signature.sorts.items()
        )
        facts = frozenset(
            ground(static, (names[a] for a in terms))
            for first in (*kept, "")
            for static, terms in self._facts.get(first, ())
            if all(a in names for a in terms)
        )
        return CompactPart(self, sorts, facts, names)


class CompactPart:
    """A part of a description in canonical names.

    `sorts` are the members of each sort and `facts` the true statics that are stated; two parts
    with equal ones have the same transitions. `names` leads from the old names to the canonical
    ones.
    """

    def __init__(
        self,
        whole: CompactDescription,
        sorts: tuple[tuple[str, tuple[str, ...]], ...],
        facts: frozenset[str],
        names: Mapping[str, str],
    ) -> None:
        self.names = names
        self.sorts = dict(sorts)
        self.key = sorts, facts
        self._whole = whole
        self._facts = facts
        self._back = {new: old for old, new in names.items()}

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

    @cached_property
    def rules(self) -> Sequence[Rule]:
        """The rules that name nothing else."""
        return [rule for rule in self._whole.rules if rule.constants <= self.names.keys()]

    @cached_property
    def actions(self) -> Sequence[str]:
        """The agent actions in the order of declaration, in canonical names."""
        return [
            ground(symbol.name, chosen)
            for symbol in self._whole.signature.symbols.values()
            if symbol.kind == "agent"
            for chosen in product(*(self.sorts[sort.name] for sort in symbol.sorts))
        ]

    @cached_property
    def program(self) -> str:
        """The compact program."""
        facts = [f"{sort}({member})." for sort, ms in self.sorts.items() for member in ms]
        facts += (f"{fact}." for fact in sorted(self._facts))
        return "\n".join([self.worded(Rule.plain), f"#program {Part.BASE}.", *facts])

    def worded(self, wording: Callable[[Rule], Iterable[str]]) -> str:
        """The rules of the program, without the facts about constants and statics."""
        parts: dict[Part, list[str]] = {part: [] for part in Part}
        for rule in self.rules:
            parts[rule.part] += wording(rule)
        parts[Part.BASE] += (f"#defined {sort}/1." for sort in self.sorts)
        for symbol in self._whole.signature.symbols.values():
            if symbol.kind == "static":
                parts[Part.BASE].append(f"#defined {symbol.name}/{len(symbol.sorts)}.")
        return "\n".join(f"#program {part}.\n" + "\n".join(lines) for part, lines in parts.items())
