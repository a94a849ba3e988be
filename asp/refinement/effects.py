"""What a coarse action brings about, in the terms of one law that names it."""

from __future__ import annotations

from dataclasses import replace

from asp.language import atom_text, syntax

Effect = tuple[syntax.Literal, syntax.Body]


def effects_of(action: syntax.Atom, coarse: syntax.Source) -> list[Effect]:
    """What the coarse action causes and under which conditions, in the terms of this atom."""
    found = []
    for law in coarse.each(syntax.CausalLaw):
        terms = _matched(law.action, action)
        if terms is not None:
            head = replace(law.head, atom=_substituted(law.head.atom, terms))
            found.append((head, tuple(_condition(part, terms) for part in law.body)))
    return found


def _matched(of_law: syntax.Atom, action: syntax.Atom) -> dict[str, syntax.Term] | None:
    """The terms for the variables of a causal law's action that make it the given one."""
    if of_law.name != action.name:
        return None
    terms: dict[str, syntax.Term] = {}
    for variable, term in zip(of_law.args, action.args, strict=True):
        if not variable.is_variable:
            if not term.is_variable and term.name != variable.name:
                return None
        elif terms.setdefault(variable.name, term).name != term.name:
            return None
    return terms


def _condition(part: syntax.Condition, terms: dict[str, syntax.Term]) -> syntax.Condition:
    if isinstance(part, syntax.Literal):
        return replace(part, atom=_substituted(part.atom, terms))
    left, right = (_term(side, terms) for side in (part.left, part.right))
    return replace(part, left=left, right=right)


def _substituted(atom: syntax.Atom, terms: dict[str, syntax.Term]) -> syntax.Atom:
    return replace(atom, args=tuple(_term(term, terms) for term in atom.args))


def _term(term: syntax.Term, terms: dict[str, syntax.Term]) -> syntax.Term:
    """The term for a variable of the action; another variable gets a name of the effect's own."""
    if not term.is_variable:
        return term
    return terms.get(term.name, replace(term, name=f"{term.name}_"))


def key(part: syntax.Condition) -> str:
    """The text of a condition, by which conditions at different places are the same."""
    if isinstance(part, syntax.Literal):
        return ("" if part.positive else "-") + atom_text(part.atom)
    return f"{part.left.name}{part.equal}{part.right.name}"
