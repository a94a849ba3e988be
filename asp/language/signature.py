"""The sorted signature of a description: its sorts with their members, its symbols."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass

from asp.language import syntax
from asp.language.errors import SourceError
from asp.language.reserved_names import is_reserved_constant, is_reserved_sort, is_reserved_symbol
from asp.language.spelling import suggestion


class Problems(list[SourceError]):
    """The mistakes found so far in one text.

    `failed` are the declarations whose names cannot be what they were meant to be: what uses
    the names that were meant is right.
    """

    def __init__(self, file: str) -> None:
        super().__init__()
        self.file = file
        self.failed: list[syntax.Declaration] = []

    def report(self, place: syntax.Place, message: str) -> None:
        self.append(SourceError(self.file, place.line, place.column, message))

    def raise_first(self) -> None:
        """Raises the first mistake in the order of the source, which then knows all of them."""
        if self:
            ordered = sorted(self, key=lambda error: (error.line, error.column))
            ordered[0].all = tuple(ordered)
            raise ordered[0]


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


def _report_sort(name: str, place: syntax.Place, sorts: Iterable[str], problems: Problems) -> None:
    problems.report(place, f"unknown sort '{name}'; {suggestion(name, sorts)}")


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
            problems.report(
                part.place, f"unknown sort '{part.name}'; {suggestion(part.name, sorts)}"
            )
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
            problems.report(
                sort.place, f"unknown sort '{sort.name}'; {suggestion(sort.name, sorts)}"
            )
