"""Fluents that come true only by actions that are impossible unless something else holds."""

from __future__ import annotations

from asp.language import syntax

Substitution = dict[str, str]


def comes_true_only_while(
    condition: syntax.Literal, head: syntax.Literal, source: syntax.Source
) -> bool:
    """Whether nothing makes a positive condition true but actions impossible while `head` is false.

    A constraint `head if condition` then says only what was so already when the condition came
    true. Decided by the form of the laws: False where that does not tell.
    """
    name = condition.atom.name
    derived = any(
        law.head.atom.name == name and law.head.positive
        for law in source.each(syntax.StateConstraint)
    )
    makers = [
        law
        for law in source.each(syntax.CausalLaw)
        if law.head.atom.name == name and law.head.positive
    ]
    return not derived and all(_is_guarded(law, condition, head, source) for law in makers)


def _is_guarded(
    maker: syntax.CausalLaw, condition: syntax.Literal, head: syntax.Literal, source: syntax.Source
) -> bool:
    """Whether an executability condition forbids the action, as far as it makes the condition true.

    That is, one without other conditions than that the head is false.
    """
    made: Substitution = {}
    if not _match(maker.head.atom, condition.atom, made):
        return False
    action = [made.get(term.name, term.name) for term in maker.action.args]
    return any(
        len(law.actions) == 1
        and law.actions[0].name == maker.action.name
        and _forbids(law, action, head)
        for law in source.each(syntax.ExecutabilityCondition)
    )


def _forbids(law: syntax.ExecutabilityCondition, action: list[str], head: syntax.Literal) -> bool:
    if len(law.body) != 1 or not isinstance(law.body[0], syntax.Literal):
        return False
    found: Substitution = {}
    literal = law.body[0]
    return (
        literal.positive != head.positive
        and literal.atom.name == head.atom.name
        and _bind(law.actions[0], action, found)
        and _match(literal.atom, head.atom, found)
    )


def _match(pattern: syntax.Atom, atom: syntax.Atom, found: Substitution) -> bool:
    """Extends a substitution of the pattern's variables so that it becomes the atom."""
    return _bind(pattern, [term.name for term in atom.args], found)


def _bind(pattern: syntax.Atom, names: list[str], found: Substitution) -> bool:
    return len(pattern.args) == len(names) and all(
        found.setdefault(term.name, given) == given if term.is_variable else term.name == given
        for term, given in zip(pattern.args, names, strict=True)
    )
