"""The laws of a description as facts, for theories that are about laws."""

from collections.abc import Iterator

from clingo import Symbol

from asp.language import Causal, Constraint, Description, Literal
from asp.solving import fact


def laws(description: Description) -> Iterator[Symbol]:
    """fluent(F), defined(F); law(R,L) with needs(R,L1), and causes(A,R) where it is of an action.

    An executability condition X of a single action is hinders(X,A) with while(X,L). What others do
    is of the action `nobody`, which cannot occur.
    """
    yield from (fact("fluent", fluent) for fluent in description.fluents)
    yield from (fact("defined", fluent) for fluent in description.defined)
    every: list[Causal | Constraint] = [*description.causal, *description.constraints]
    for number, law in enumerate(every):
        yield fact("law", number, term(law.head))
        yield from (fact("needs", number, term(literal)) for literal in law.body)
    own = frozenset(description.agent_actions)
    for number, causal in enumerate(description.causal):
        yield fact("causes", causal.action if causal.action in own else "nobody", number)
    yield fact("hinders", -1, "nobody")
    for number, condition in enumerate(description.executability):
        for action in condition.actions if len(condition.actions) == 1 else ():
            yield fact("hinders", number, action)
            yield from (fact("while", number, term(literal)) for literal in condition.body)


def term(literal: Literal) -> Symbol:
    """The literal as yes(F) or no(F)."""
    return fact("yes" if literal.is_positive else "no", literal.atom)
