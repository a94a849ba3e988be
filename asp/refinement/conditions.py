"""Executability conditions at the fine resolution."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from itertools import product

from asp.language import atom_text, syntax
from asp.language import variable_sorts as roles
from asp.refinement.effects import effects_of, key
from asp.refinement.renaming import Renaming
from asp.refinement.rewriting import Rewriting


def refined_condition(
    law: syntax.ExecutabilityCondition, renaming: Renaming, rewriting: Rewriting
) -> syntax.ExecutabilityCondition:
    """The condition about the counterparts of what it is about."""
    actions = tuple(map(renaming.atom, law.actions))
    effects = {
        atom_text(head.atom)
        for action in law.actions
        for head, _ in effects_of(action, rewriting.coarse)
    }
    acted = {term.name for action in law.actions for term in action.args}
    body: list[syntax.Condition] = []
    for part in law.body:
        (condition,) = renaming.body((part,))
        if isinstance(part, syntax.Literal) and atom_text(part.atom) not in effects:
            condition = _about_any_component(part, condition, acted, renaming, rewriting)
        body.append(condition)
    return replace(law, actions=actions, body=(*body, *renaming.links()))


def _about_any_component(
    part: syntax.Literal,
    condition: syntax.Condition,
    acted: set[str],
    renaming: Renaming,
    rewriting: Rewriting,
) -> syntax.Condition:
    """A condition on what the action is about: any of its components may meet it.

    Not so where a law of the refinement says that the components share the fluent anyway.
    """
    assert isinstance(condition, syntax.Literal)
    symbol = rewriting.vocabulary.coarse.symbols.get(part.atom.name)
    if not part.positive or symbol is None or symbol.kind not in roles.FLUENTS:
        return condition
    terms = tuple(
        renaming.another(whole)
        if renaming.is_magnified(whole)
        and whole.name in acted
        and (condition.atom.name, place) not in rewriting.shared
        else term
        for place, (whole, term) in enumerate(zip(part.atom.args, condition.atom.args, strict=True))
    )
    return replace(condition, atom=replace(condition.atom, args=terms))


def lifted(law: syntax.ExecutabilityCondition, rewriting: Rewriting) -> Iterator[syntax.Statement]:
    """The condition as it is, for the fine actions that would bring about the coarse effects."""
    effects = [effects_of(a, rewriting.coarse) for a in law.actions if rewriting.has_counterpart(a)]
    given = set(map(key, law.body))
    for brought in product(*filter(None, effects)):
        if any(key(head) in given for head, _ in brought):
            continue
        changes: list[syntax.Condition] = []
        for head, conditions in brought:
            changes += (replace(head, positive=not head.positive), *conditions)
        body = (*(c for c in changes if key(c) not in given), *law.body)
        renaming = Renaming(law, rewriting.vocabulary)
        actions = tuple(
            renaming.atom(action) if rewriting.has_counterpart(action) else action
            for action in law.actions
        )
        for literal in roles.literals(body):
            for term in literal.atom.args:
                renaming.whole(term)
        yield replace(law, actions=actions, body=(*renaming.links(), *body))
