"""A description restricted to some of its constants: the others and all about them left out."""

from collections.abc import Collection, Iterator
from dataclasses import replace

from asp.language import syntax
from asp.language import variable_sorts as roles
from asp.language.signature import Signature


def restrict(source: syntax.Source, dropped: Collection[str]) -> syntax.Source:
    """The source without the dropped constants: sorts lose them, statements that name one go.

    Instances of the remaining statements are then those that can still be written.
    """
    gone = frozenset(dropped)
    statements = tuple(
        _without(statement, gone) if isinstance(statement, syntax.SortDefinition) else statement
        for statement in source.statements
        if gone.isdisjoint(named(statement))
    )
    return replace(source, statements=statements)


def without_exogenous(source: syntax.Source, signature: Signature) -> syntax.Source:
    """The source without exogenous actions and what is said of them."""
    gone = {symbol.name for symbol in signature.of_kind("exogenous")}
    return replace(
        source,
        statements=tuple(
            statement
            for statement in source.statements
            if not (isinstance(statement, syntax.Declaration) and statement.name in gone)
            and gone.isdisjoint(use.atom.name for use in roles.uses(statement))
        ),
    )


def narrowed(signature: Signature, dropped: Collection[str]) -> Signature:
    """The signature whose sorts have lost the dropped constants."""
    sorts = {
        name: tuple(member for member in members if member not in dropped)
        for name, members in signature.sorts.items()
    }
    return Signature(sorts, signature.symbols)


def named(statement: syntax.Statement) -> Iterator[str]:
    """The constants that a statement names, members of sorts apart."""
    terms = [term for use in roles.uses(statement) for term in use.atom.args]
    for comparison in roles.comparisons(roles.bodies(statement)):
        terms += comparison.terms
    if isinstance(statement, syntax.SeesStatement):
        terms.append(statement.robot)
    return (term.name for term in terms if not term.is_variable)


def _without(definition: syntax.SortDefinition, gone: frozenset[str]) -> syntax.SortDefinition:
    parts = (
        tuple(each for each in part if each.name not in gone) if isinstance(part, tuple) else part
        for part in definition.parts
    )
    return replace(definition, parts=tuple(part for part in parts if part))
