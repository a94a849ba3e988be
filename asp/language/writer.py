"""From abstract syntax back to AL_d text."""

from __future__ import annotations

from collections.abc import Iterable
from functools import singledispatch

from asp.language import syntax


@singledispatch
def text_of(statement: syntax.Statement) -> str:
    """The statement on one line, with its full stop. Raises TypeError for kinds not listed here."""
    raise TypeError(f"{type(statement).__name__} has no text here")


@text_of.register
def _(statement: syntax.SortDefinition) -> str:
    parts = (
        "{" + _listed(part) + "}" if isinstance(part, tuple) else part.name
        for part in statement.parts
    )
    return f"{statement.name} = {' + '.join(parts)}."


@text_of.register
def _(statement: syntax.Declaration) -> str:
    kind = "" if statement.kind == "static" else f"{statement.kind} "
    arguments = f"({_listed(statement.sorts)})" if statement.sorts else ""
    return f"{kind}{statement.name}{arguments}."


@text_of.register
def _(law: syntax.CausalLaw) -> str:
    return f"{atom_text(law.action)} causes {_literal(law.head)}{_if(law.body)}."


@text_of.register
def _(law: syntax.StateConstraint) -> str:
    return f"{_literal(law.head)}{_if(law.body)}."


@text_of.register
def _(law: syntax.ExecutabilityCondition) -> str:
    return f"impossible {', '.join(map(atom_text, law.actions))}{_if(law.body)}."


@text_of.register
def _(fact: syntax.Fact) -> str:
    return f"{_literal(fact.literal)}."


@text_of.register
def _(statement: syntax.SeesStatement) -> str:
    fluent = atom_text(statement.fluent)
    return f"{statement.robot.name} sees {fluent}{_if(statement.body)}."


@text_of.register
def _(statement: syntax.ShowsStatement) -> str:
    shown = f"{atom_text(statement.action)} shows {atom_text(statement.fluent)}"
    return f"{shown}{_if(statement.body)}."


@text_of.register
def _(statement: syntax.InitiallyStatement) -> str:
    return f"{atom_text(statement.fluent)} for some {statement.variable.name}."


def atom_text(atom: syntax.Atom) -> str:
    """A fluent, static or action as it is written, blanks after commas."""
    return f"{atom.name}({_listed(atom.args)})" if atom.args else atom.name


def _listed(terms: Iterable[syntax.Term]) -> str:
    return ", ".join(term.name for term in terms)


def _literal(literal: syntax.Literal) -> str:
    return ("" if literal.positive else "-") + atom_text(literal.atom)


def _if(body: syntax.Body) -> str:
    return f" if {', '.join(map(condition_text, body))}" if body else ""


def condition_text(condition: syntax.Condition) -> str:
    """A literal or comparison of a body as it is written."""
    if isinstance(condition, syntax.Literal):
        return _literal(condition)
    sign = "=" if condition.equal else "!="
    return f"{condition.left.name} {sign} {condition.right.name}"
