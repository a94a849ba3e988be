"""Pieces of ASP text made of abstract syntax."""

from __future__ import annotations

from collections.abc import Iterable

from asp.language import Signature, syntax


def rule(head: str, body: Iterable[str]) -> str:
    """`head :- body.`, a fact if the body is empty, a constraint if the head is."""
    conditions = ", ".join(body)
    if not conditions:
        return f"{head}."
    return f"{head} :- {conditions}." if head else f":- {conditions}."


def term_text(atom: syntax.Atom) -> str:
    """A fluent, static or action as a term or atom of ASP."""
    arguments = ",".join(term.name for term in atom.args)
    return f"{atom.name}({arguments})" if arguments else atom.name


def condition(part: syntax.Condition, signature: Signature, step: str = "I") -> str:
    """A condition of a body: fluents in `holds`, statics and sorts as they stand."""
    if isinstance(part, syntax.Comparison):
        return f"{part.left.name} {'=' if part.equal else '!='} {part.right.name}"
    sign = "" if part.positive else "-"
    name = part.atom.name
    if name in signature.sorts or signature.symbols[name].kind == "static":
        return sign + term_text(part.atom)
    return f"{sign}holds({term_text(part.atom)},{step})"
