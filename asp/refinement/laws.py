"""The laws of a coarse description at the fine resolution, one coarse law after the other.

A law about attributes and actions with counterparts becomes a law about the counterparts; one
without any stays; a condition that ties an action with a counterpart to an attribute without one
is kept as it is about the coarse attributes, for the fine actions that would bring about what the
coarse action does.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace
from functools import singledispatch

from asp.language import syntax, text_of
from asp.language import variable_sorts as roles
from asp.refinement.conditions import lifted, refined_condition
from asp.refinement.renaming import Renaming
from asp.refinement.rewriting import Rewriting

KEPT, REFINED, LIFTED = "kept", "refined", "lifted"


@dataclass(frozen=True)
class Result:
    """A statement of the refined description: what it is, and what it came from."""

    statement: syntax.Statement
    manner: str
    origin: str


def refine(law: syntax.Statement, rewriting: Rewriting) -> Iterator[Result]:
    """The statements that a coarse one becomes. Reports a law that cannot be refined."""
    for statement, manner in refined(law, rewriting):
        yield Result(statement, manner, f"line {law.place.line}: {text_of(law)}")


Refined = Iterator[tuple[syntax.Statement, str]]


@singledispatch
def refined(_law: syntax.Statement, _: Rewriting) -> Refined:
    """What a statement becomes, with the manner in which; nothing: it falls away."""
    yield from ()


@refined.register
def _(fact: syntax.Fact, _: Rewriting) -> Refined:
    yield fact, KEPT


@refined.register
def _(law: syntax.CausalLaw, rewriting: Rewriting) -> Refined:
    acts, concerns = map(rewriting.has_counterpart, (law.action, law.head.atom))
    if acts:
        yield _refined_causal(law, rewriting), REFINED
    elif not concerns:
        yield law, KEPT
    else:
        name = law.action.name
        rewriting.problems.report(
            law.place,
            f"'{name}' changes '{law.head.atom.name}', which has a counterpart, so that '{name}' "
            "needs one",
        )


def _refined_causal(law: syntax.CausalLaw, rewriting: Rewriting) -> syntax.CausalLaw:
    renaming = Renaming(law, rewriting.vocabulary)
    action, head = renaming.atom(law.action), renaming.literal(law.head)
    body = renaming.body(law.body)
    bound = {term.name for term in action.args}
    if head.positive and rewriting.has_counterpart(law.head.atom):
        free = [t for t in head.atom.args if t.is_variable and t.name not in bound]
        _check_head(law, free, renaming, rewriting)
    return replace(law, action=action, head=head, body=(*renaming.links(), *body))


@refined.register
def _(law: syntax.StateConstraint, rewriting: Rewriting) -> Refined:
    static = rewriting.vocabulary.coarse.symbols[law.head.atom.name].kind == "static"
    concerns = rewriting.has_counterpart(law.head.atom)
    if static or not concerns:
        yield law, KEPT
    if concerns:
        renaming = Renaming(law, rewriting.vocabulary)
        head, body = renaming.literal(law.head), renaming.body(law.body)
        statement = replace(law, head=head, body=(*renaming.links(), *body))
        if static and renaming.links():
            return
        if head.positive:
            _check_head(law, head.atom.args, renaming, rewriting)
        yield statement, REFINED


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


@refined.register
def _(law: syntax.ExecutabilityCondition, rewriting: Rewriting) -> Refined:
    if not any(map(rewriting.has_counterpart, law.actions)):
        yield law, KEPT
        return
    renaming = Renaming(law, rewriting.vocabulary)
    if renaming.is_about_wholes(law):
        for statement in lifted(law, rewriting):
            yield statement, LIFTED
    else:
        yield refined_condition(law, renaming, rewriting), REFINED


@refined.register
def _(statement: syntax.InitiallyStatement, rewriting: Rewriting) -> Refined:
    if not rewriting.has_counterpart(statement.fluent):
        yield statement, KEPT
        return
    renaming = Renaming(statement, rewriting.vocabulary)
    fluent = renaming.atom(statement.fluent)
    yield replace(statement, fluent=fluent, variable=renaming.fine(statement.variable)), REFINED


@refined.register
def _(statement: syntax.SeesStatement, rewriting: Rewriting) -> Refined:
    if not rewriting.has_counterpart(statement.fluent):
        yield statement, KEPT


@refined.register
def _(statement: syntax.ShowsStatement, rewriting: Rewriting) -> Refined:
    if rewriting.has_counterpart(statement.fluent):
        return
    if not rewriting.has_counterpart(statement.action):
        yield statement, KEPT
        return
    renaming = Renaming(statement, rewriting.vocabulary)
    action = renaming.atom(statement.action)
    for term in statement.fluent.args:
        renaming.whole(term)
    for literal in roles.literals(statement.body):
        for term in literal.atom.args:
            renaming.whole(term)
    yield replace(statement, action=action, body=(*renaming.links(), *statement.body)), REFINED
