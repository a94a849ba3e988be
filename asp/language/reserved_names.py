"""Names to which the programs give a meaning of their own: a domain has to use others."""

from __future__ import annotations

from functools import cache
from importlib.resources import files

import clingo
from clingo import ast

from asp.language.syntax import SymbolKind

_CONSTANTS = frozenset({"n", "not"})
_ENVIRONMENT = frozenset({"wait", "none"})
_REFINED = frozenset({"component", "fine", "coarse", "outcome"})
"""Names that refined descriptions declare, so that theories of them may speak of them."""


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
