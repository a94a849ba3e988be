"""The sorted signature of a description: its sorts with their members, its symbols.

Names to which the programs give a meaning of their own are reserved: a domain has to use others.
"""

from collections import defaultdict
from collections.abc import Collection, Iterable, Mapping
from dataclasses import dataclass
from functools import cache
from importlib.resources import files
from itertools import product

from clingo import SymbolType, ast
from clingo.ast import ASTType

from asp.language import syntax
from asp.language.errors import Problems, suggestion
from asp.language.literals import Literal

_CONSTANTS = frozenset({"n", "not"})
_ENVIRONMENT = frozenset({"wait", "none"})
_REFINED = frozenset({"component", "fine", "coarse", "outcome"})
"""Names that refined descriptions declare, so that theories of them may speak of them."""


@dataclass(frozen=True)
class Signature:
    """Sorts (members in the order of declaration) and declared symbols, both by name."""

    sorts: Mapping[str, tuple[str, ...]]
    symbols: Mapping[str, syntax.Declaration]

    @property
    def constants(self) -> frozenset[str]:
        return frozenset(member for members in self.sorts.values() for member in members)

    def sorts_of(self, name: str) -> list[str]:
        """The sorts of the arguments of a declared symbol; a sort has itself for the only one."""
        return [name] if name in self.sorts else [sort.name for sort in self.symbols[name].sorts]

    def kind(self, name: str) -> str | None:
        """What a name is: the kind of a declared symbol, or `sort`; None: nothing."""
        if name in self.sorts:
            return "sort"
        symbol = self.symbols.get(name)
        return None if symbol is None else symbol.kind

    def of_kind(self, kind: syntax.SymbolKind) -> list[syntax.Declaration]:
        """The declared symbols of a kind, in order."""
        return [symbol for symbol in self.symbols.values() if symbol.kind == kind]

    def atoms(self, kind: syntax.SymbolKind) -> tuple[Literal, ...]:
        """The ground fluents or actions of a kind, in the order of declaration."""
        return tuple(
            Literal.of(symbol.name, arguments)
            for symbol in self.of_kind(kind)
            for arguments in product(*map(self.sorts.__getitem__, self.sorts_of(symbol.name)))
        )


def signature_of(source: syntax.Source, problems: Problems) -> Signature:
    """The signature that the sorts, statics, fluents and actions sections declare."""
    sorts: dict[str, tuple[str, ...]] = {}
    symbols: dict[str, syntax.Declaration] = {}
    taken: dict[str, int] = {}
    for statement in source.statements:
        if not isinstance(statement, syntax.SortDefinition | syntax.Declaration):
            continue
        name, found = statement.name, len(problems)
        if name in taken:
            message = f"the name '{name}' is used twice; first in line {taken[name]}"
            problems.report(statement.place, message)
        taken.setdefault(name, statement.place.line)
        if isinstance(statement, syntax.SortDefinition):
            check_reserved(name, "sort", statement.place, problems)
            sorts[name] = _members(statement, sorts, problems)
            continue
        check_reserved(name, statement.kind, statement.place, problems)
        if len(problems) > found:
            problems.failed += [symbols.get(name, statement), statement]
        for sort in statement.sorts:
            if sort.name not in sorts:
                _report_sort(sort, sorts, problems)
        symbols[name] = statement
    return Signature(sorts, symbols)


def _report_sort(sort: syntax.Term, sorts: Iterable[str], problems: Problems) -> None:
    problems.report(sort.place, f"unknown sort '{sort.name}'; {suggestion(sort.name, sorts)}")


def _members(
    definition: syntax.SortDefinition, sorts: Mapping[str, tuple[str, ...]], problems: Problems
) -> tuple[str, ...]:
    members: list[str] = []
    for part in definition.parts:
        if isinstance(part, tuple):
            _check_constants(part, definition, problems)
            members += (constant.name for constant in part)
        elif part.name in sorts:
            members += sorts[part.name]
        else:
            _report_sort(part, sorts, problems)
    return tuple(dict.fromkeys(members))


def _check_constants(
    constants: tuple[syntax.Term, ...], definition: syntax.SortDefinition, problems: Problems
) -> None:
    if not constants:
        problems.report(definition.place, f"the range of sort '{definition.name}' is empty")
    if len(constants) > syntax.MOST_MEMBERS:
        message = (
            f"sort '{definition.name}' is too large; {syntax.MOST_MEMBERS} members are the most"
        )
        problems.report(definition.place, message)
        return
    seen = set()
    for constant in constants:
        if constant.name in seen:
            problems.report(constant.place, f"the name '{constant.name}' is used twice in one sort")
        else:
            check_reserved(constant.name, "constant", constant.place, problems)
        seen.add(constant.name)


def check_reserved(name: str, kind: str, place: syntax.Place, problems: Problems) -> None:
    """Reports a name of a constant, sort or symbol that means something else in programs."""
    if name in _reserved(kind):
        problems.report(place, f"the name '{name}' means something else in programs; take another")


@cache
def _reserved(kind: str) -> frozenset[str]:
    words = _words()
    if kind in ("sort", "static"):
        return _CONSTANTS.union(words[ASTType.SymbolicAtom] - _REFINED)
    names = _CONSTANTS | words[ASTType.Definition]
    return names if kind == "constant" else names | words[ASTType.Function] | _ENVIRONMENT


@cache
def _words() -> Mapping[ASTType, set[str]]:
    """The names in all of `asp/theories`: of predicates, of terms, and of defined constants."""
    names: dict[ASTType, set[str]] = defaultdict(set)

    def collect(node: ast.AST) -> None:
        kind = node.ast_type
        if kind == ASTType.SymbolicAtom:  # a function, or its negation
            node = node.symbol
            while node.ast_type == ASTType.UnaryOperation:
                node = node.argument
        if kind in (ASTType.SymbolicAtom, ASTType.Function, ASTType.Definition):
            names[kind].add(node.name)
        elif kind == ASTType.SymbolicTerm and node.symbol.type == SymbolType.Function:
            names[ASTType.Function].add(node.symbol.name)
        for children in (getattr(node, key) for key in node.child_keys):
            for child in [children] if isinstance(children, ast.AST) else children or ():
                collect(child)

    for entry in files("asp").joinpath("theories").iterdir():
        if entry.name.endswith(".lp"):
            ast.parse_string(entry.read_text(encoding="utf-8"), collect)
    return names


def unknown_atom(
    text: Literal, signature: Signature, kinds: Collection[str], what: str
) -> str | None:
    """What is wrong with a ground atom that is none of these kinds, and what is right, if so."""
    symbols = {name: own for name, own in signature.symbols.items() if own.kind in kinds}
    name, values = text.name, text.arguments
    if name not in symbols:
        return f"no {what} '{name}'; {suggestion(name, symbols)}"
    sorts = [signature.sorts[sort.name] for sort in symbols[name].sorts]
    example = Literal.of(name, (members[0] for members in sorts))
    if len(values) != len(sorts):
        return f"{name} takes {len(sorts)} arguments, as in {example}"
    for value, members in zip(values, sorts, strict=True):
        if value not in members:
            return f"'{value}' in {text} is not known there; {suggestion(value, members)}"
    return None if text.is_positive else f"{text} has a sign; write it as in {example}"
