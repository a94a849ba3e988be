"""The sorted signature of a description: its sorts with their members, its symbols.

Names to which the programs give a meaning of their own are reserved: a domain has to use others.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from functools import cache
from importlib.resources import files

import clingo
from clingo import ast

from asp.language import syntax
from asp.language.errors import Problems, suggestion
from asp.language.syntax import SymbolKind

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


def signature_of(source: syntax.Source, problems: Problems) -> Signature:
    """The signature that the sorts, statics, fluents and actions sections declare."""
    sorts: dict[str, tuple[str, ...]] = {}
    symbols: dict[str, syntax.Declaration] = {}
    taken: dict[str, int] = {}
    for statement in source.statements:
        if isinstance(statement, syntax.SortDefinition):
            _claim(statement.name, statement, taken, problems)
            if is_reserved_sort(statement.name):
                report_reserved(statement.name, statement.place, problems)
            sorts[statement.name] = _members(statement, sorts, problems)
        elif isinstance(statement, syntax.Declaration):
            found = len(problems)
            _claim(statement.name, statement, taken, problems)
            if is_reserved_symbol(statement.name, statement.kind):
                report_reserved(statement.name, statement.place, problems)
            if len(problems) > found:
                first = symbols.get(statement.name, statement)
                problems.failed += [first, statement]
            _check_sorts(statement, sorts, problems)
            symbols[statement.name] = statement
    return Signature(sorts, symbols)


def _report_sort(sort: syntax.Term, sorts: Iterable[str], problems: Problems) -> None:
    problems.report(sort.place, f"unknown sort '{sort.name}'; {suggestion(sort.name, sorts)}")


def _claim(
    name: str, statement: syntax.Statement, taken: dict[str, int], problems: Problems
) -> None:
    if name in taken:
        problems.report(
            statement.place, f"the name '{name}' is used twice; first in line {taken[name]}"
        )
    taken.setdefault(name, statement.place.line)


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
        elif is_reserved_constant(constant.name):
            report_reserved(constant.name, constant.place, problems)
        seen.add(constant.name)


def report_reserved(name: str, place: syntax.Place, problems: Problems) -> None:
    """Reports a name to which the programs give a meaning of their own."""
    problems.report(place, f"the name '{name}' means something else in programs; take another")


def _check_sorts(
    declaration: syntax.Declaration, sorts: Mapping[str, tuple[str, ...]], problems: Problems
) -> None:
    for sort in declaration.sorts:
        if sort.name not in sorts:
            _report_sort(sort, sorts, problems)


def is_reserved_constant(name: str) -> bool:
    """Whether a member of a sort cannot have this name."""
    return name in _CONSTANTS or name in _words().constants


def is_reserved_symbol(name: str, kind: SymbolKind) -> bool:
    """Whether a static, fluent or action cannot have this name."""
    if kind == "static":
        return is_reserved_sort(name)
    return is_reserved_constant(name) or name in _ENVIRONMENT or name in _words().terms


def is_reserved_sort(name: str) -> bool:
    """Whether a sort cannot have this name."""
    return name in _CONSTANTS or name in _words().predicates - _REFINED


class _Words(ast.Transformer):
    """Collects the names that stand in programs, by what they stand for."""

    def __init__(self) -> None:
        self.predicates: set[str] = set()
        self.terms: set[str] = set()
        self.constants: set[str] = set()

    def collect(self, statement: ast.AST) -> None:
        self.visit(statement)

    def visit_SymbolicAtom(self, node: ast.AST) -> ast.AST:  # noqa: N802 (clingo's name)
        symbol = node.symbol
        while symbol.ast_type == ast.ASTType.UnaryOperation:
            symbol = symbol.argument
        self.predicates.add(symbol.name)
        self.visit_sequence(symbol.arguments)
        return node

    def visit_Function(self, node: ast.AST) -> ast.AST:  # noqa: N802
        self.terms.add(node.name)
        self.visit_sequence(node.arguments)
        return node

    def visit_SymbolicTerm(self, node: ast.AST) -> ast.AST:  # noqa: N802
        if node.symbol.type == clingo.SymbolType.Function:
            self.terms.add(node.symbol.name)
        return node

    def visit_Definition(self, node: ast.AST) -> ast.AST:  # noqa: N802
        self.constants.add(node.name)
        return node


@cache
def _words() -> _Words:
    """The names in all of `asp/theories`."""
    words = _Words()
    for entry in files("asp").joinpath("theories").iterdir():
        if entry.name.endswith(".lp"):
            ast.parse_string(entry.read_text(encoding="utf-8"), words.collect)
    return words
