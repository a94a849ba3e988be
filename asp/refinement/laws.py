"""The laws of a coarse description at the fine resolution, one coarse law after the other.

A law about attributes and actions with counterparts becomes a law about the counterparts; one
without any stays; a condition that ties an action with a counterpart to an attribute without one
is kept as it is about the coarse attributes, for the fine actions that would bring about what the
coarse action does.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace
from itertools import product

from asp.language import Problems, syntax, text_of
from asp.language import variable_sorts as roles
from asp.refinement.renaming import Renaming, effects_of
from asp.refinement.vocabulary import Vocabulary

KEPT, REFINED, LIFTED = "kept", "refined", "lifted"


@dataclass(frozen=True)
class Rewriting:
    """The names, the coarse text, and the places of fluents that components share.

    `problems` are those of the coarse text: laws that cannot be refined are reported there.
    """

    vocabulary: Vocabulary
    coarse: syntax.Source
    shared: frozenset[tuple[str, int]]
    problems: Problems

    def has_counterpart(self, atom: syntax.Atom) -> bool:
        return atom.name in self.vocabulary.counterparts


@dataclass(frozen=True)
class Result:
    """A statement of the refined description, and its text with what it came from."""

    statement: syntax.Statement
    manner: str
    text: str


def refine(law: syntax.Statement, rewriting: Rewriting) -> Iterator[Result]:
    """The statements that a coarse one becomes. Reports a law that cannot be refined."""
    for statement, manner in _refined(law, rewriting):
        text = f"{text_of(statement)}  % line {law.place.line}: {text_of(law)}"
        yield Result(statement, manner, text)


Refined = Iterator[tuple[syntax.Statement, str]]


def _refined(law: syntax.Statement, rewriting: Rewriting) -> Refined:
    """What a statement becomes, with the manner in which; nothing: it falls away."""
    has_counterpart = rewriting.has_counterpart
    match law:
        case syntax.Fact():
            yield law, KEPT
        case syntax.CausalLaw(action=action) if has_counterpart(action):
            yield _refined_causal(law, rewriting), REFINED
        case syntax.CausalLaw(action=action, head=head) if has_counterpart(head.atom):
            rewriting.problems.report(
                law.place,
                f"'{action.name}' changes '{head.atom.name}', which has a counterpart, so that "
                f"'{action.name}' needs one",
            )
        case syntax.StateConstraint():
            yield from _refined_constraint(law, rewriting)
        case syntax.ExecutabilityCondition(actions=actions) if any(map(has_counterpart, actions)):
            renaming = Renaming(law, rewriting.vocabulary)
            if renaming.is_about_wholes(law):
                yield from ((statement, LIFTED) for statement in _lifted(law, rewriting))
            else:
                yield _refined_condition(law, renaming, rewriting), REFINED
        case syntax.InitiallyStatement(fluent=fluent) if has_counterpart(fluent):
            renaming = Renaming(law, rewriting.vocabulary)
            fluent, variable = renaming.atom(fluent), renaming.fine(law.variable)
            yield replace(law, fluent=fluent, variable=variable), REFINED
        case syntax.SeesStatement(fluent=fluent) if has_counterpart(fluent):
            pass
        case syntax.ShowsStatement(fluent=fluent) if has_counterpart(fluent):
            pass
        case syntax.ShowsStatement(action=action) if has_counterpart(action):
            renaming = Renaming(law, rewriting.vocabulary)
            action = renaming.atom(action)
            renaming.note(law.fluent, *(part.atom for part in roles.literals(law.body)))
            yield replace(law, action=action, body=(*renaming.links(), *law.body)), REFINED
        case (
            syntax.CausalLaw()
            | syntax.ExecutabilityCondition()
            | syntax.InitiallyStatement()
            | syntax.SeesStatement()
            | syntax.ShowsStatement()
        ):
            yield law, KEPT


def _refined_causal(law: syntax.CausalLaw, rewriting: Rewriting) -> syntax.CausalLaw:
    renaming = Renaming(law, rewriting.vocabulary)
    action, head = renaming.atom(law.action), renaming.literal(law.head)
    body = renaming.body(law.body)
    bound = {term.name for term in action.args}
    if head.positive and rewriting.has_counterpart(law.head.atom):
        free = [t for t in head.atom.args if t.is_variable and t.name not in bound]
        _check_head(law, free, renaming, rewriting)
    return replace(law, action=action, head=head, body=(*renaming.links(), *body))


def _refined_constraint(law: syntax.StateConstraint, rewriting: Rewriting) -> Refined:
    static = rewriting.vocabulary.coarse.symbols[law.head.atom.name].kind == "static"
    concerns = rewriting.has_counterpart(law.head.atom)
    if static or not concerns:
        yield law, KEPT
    if concerns:
        renaming = Renaming(law, rewriting.vocabulary)
        head, body = renaming.literal(law.head), renaming.body(law.body)
        if static and renaming.links():
            return
        if head.positive:
            _check_head(law, head.atom.args, renaming, rewriting)
        yield replace(law, head=head, body=(*renaming.links(), *body)), REFINED


def _check_head(
    law: syntax.Statement,
    terms: list[syntax.Term] | tuple[syntax.Term, ...],
    renaming: Renaming,
    rewriting: Rewriting,
) -> None:
    """A component that is only known by its whole: the law would hold for all the components."""
    tied = {link.atom.args[0].name for link in roles.literals(renaming.links())}
    if any(term.name in tied for term in terms):
        rewriting.problems.report(
            law.place, "this law does not say for which of the components it holds"
        )


def _refined_condition(
    law: syntax.ExecutabilityCondition, renaming: Renaming, rewriting: Rewriting
) -> syntax.ExecutabilityCondition:
    """The condition about the counterparts of what it is about."""
    actions = tuple(map(renaming.atom, law.actions))
    effects = {
        text_of(head.atom)
        for action in law.actions
        for head, _ in effects_of(action, rewriting.coarse)
    }
    acted = {term.name for action in law.actions for term in action.args}
    body: list[syntax.Condition] = []
    for part in law.body:
        (condition,) = renaming.body((part,))
        if isinstance(part, syntax.Literal) and text_of(part.atom) not in effects:
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


def _lifted(law: syntax.ExecutabilityCondition, rewriting: Rewriting) -> Iterator[syntax.Statement]:
    """The condition as it is, for the fine actions that would bring about the coarse effects."""
    effects = [effects_of(a, rewriting.coarse) for a in law.actions if rewriting.has_counterpart(a)]
    given = set(map(text_of, law.body))
    for brought in product(*filter(None, effects)):
        if any(text_of(head) in given for head, _ in brought):
            continue
        changes: list[syntax.Condition] = []
        for head, conditions in brought:
            changes += (replace(head, positive=not head.positive), *conditions)
        body = (*(c for c in changes if text_of(c) not in given), *law.body)
        renaming = Renaming(law, rewriting.vocabulary)
        actions = tuple(
            renaming.atom(action) if rewriting.has_counterpart(action) else action
            for action in law.actions
        )
        renaming.note(*(part.atom for part in roles.literals(body)))
        yield replace(law, actions=actions, body=(*renaming.links(), *body))
