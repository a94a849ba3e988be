"""What the facts and static laws of a description make true, found by clingo."""

from __future__ import annotations

from asp.language import Literal, Signature, atom_text, condition_text, syntax
from asp.language import variable_sorts as roles
from asp.solving import first_model, ground


def true_statics(source: syntax.Source, signature: Signature) -> frozenset[Literal]:
    """The true statics of a checked description.

    The same as the statics of its ground description, without making the instances in Python; the
    statics must not depend on their own negation.
    """
    rules = [f"{sort}({';'.join(m)})." for sort, m in signature.sorts.items() if m]
    rules += (
        _rule(fact.literal.atom, _ranges([fact.literal.atom], signature))
        for fact in source.each(syntax.Fact)
    )
    for law in source.each(syntax.StateConstraint):
        if signature.symbols[law.head.atom.name].kind == "static":
            atoms = [use.atom for use in roles.uses(law)]
            body = [_condition(part) for part in law.body]
            rules.append(_rule(law.head.atom, [*body, *_ranges(atoms, signature)]))
    shown = [
        f"#show {name}/{len(declaration.sorts)}."
        for name, declaration in signature.symbols.items()
        if declaration.kind == "static"
    ]
    model = first_model(ground(["\n".join([*rules, "#show.", *shown])], {}, []))
    return frozenset(Literal.parse(str(static)) for static in model or ())


def _rule(head: syntax.Atom, body: list[str]) -> str:
    return f"{atom_text(head)} :- {', '.join(body)}."


def _ranges(atoms: list[syntax.Atom], signature: Signature) -> list[str]:
    """The sorts of the variables, by all the places where they stand."""
    found = (
        f"{sort.name}({term.name})"
        for atom in atoms
        if atom.name in signature.symbols
        for term, sort in zip(atom.args, signature.symbols[atom.name].sorts, strict=True)
        if term.is_variable
    )
    return list(dict.fromkeys(found))


def _condition(part: syntax.Condition) -> str:
    if isinstance(part, syntax.Comparison):
        return condition_text(part)
    return ("" if part.positive else "not ") + atom_text(part.atom)
