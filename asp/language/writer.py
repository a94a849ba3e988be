"""From abstract syntax back to AL_d text."""

from __future__ import annotations

from collections.abc import Iterable

from asp.language import syntax


def text_of(statement: syntax.Statement) -> str:
    """The statement on one line, with its full stop. Raises TypeError for kinds not listed here."""
    return f"{_text_of(statement)}."


def _text_of(statement: syntax.Statement) -> str:
    match statement:
        case syntax.SortDefinition(name=name, parts=parts):
            texts = ("{" + _listed(p) + "}" if isinstance(p, tuple) else p.name for p in parts)
            return f"{name} = {' + '.join(texts)}"
        case syntax.Declaration(kind=kind, name=name, sorts=sorts):
            arguments = f"({_listed(sorts)})" if sorts else ""
            return ("" if kind == "static" else f"{kind} ") + name + arguments
        case syntax.CausalLaw(action=action, head=head, body=body):
            return f"{atom_text(action)} causes {_literal(head)}{_if(body)}"
        case syntax.StateConstraint(head=head, body=body):
            return f"{_literal(head)}{_if(body)}"
        case syntax.ExecutabilityCondition(actions=actions, body=body):
            return f"impossible {', '.join(map(atom_text, actions))}{_if(body)}"
        case syntax.Fact(literal=literal):
            return _literal(literal)
        case syntax.SeesStatement(robot=robot, fluent=fluent, body=body):
            return f"{robot.name} sees {atom_text(fluent)}{_if(body)}"
        case syntax.ShowsStatement(action=action, fluent=fluent, body=body):
            return f"{atom_text(action)} shows {atom_text(fluent)}{_if(body)}"
        case syntax.InitiallyStatement(fluent=fluent, variable=variable):
            return f"{atom_text(fluent)} for some {variable.name}"
    raise TypeError(f"{type(statement).__name__} has no text here")


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
