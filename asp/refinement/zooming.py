"""Zooming: the part of both descriptions that a transition and a goal are about.

D_c(T, G) and D_f(T, G) are those of P 3.3, Definition 2, relCon(T, G) that of Definition 1.
"""

from collections import defaultdict
from collections.abc import Collection, Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import lru_cache

from asp.language import (
    NOTHING,
    Action,
    Facts,
    Fluent,
    Literal,
    Literals,
    Pattern,
    Problems,
    restrict,
    signature_of,
    syntax,
    variable_domains,
)
from asp.language import variable_sorts as roles
from asp.refinement.refinement import CoarseDomain, Refinement

_DOMAINS = 16


@dataclass(frozen=True)
class Transition:
    """A coarse transition <before, action, after>: the true fluents of two states, an action."""

    before: frozenset[Fluent]
    action: Action
    after: frozenset[Fluent]


def relevant(
    domain: CoarseDomain, transition: Transition | None, goal: Iterable[Literal]
) -> frozenset[str]:
    """relCon(T, G): the constants relevant to a transition or a goal (coarse literals).

    Without a transition these are the constants of the goal.
    By rule 4 these are, too, those of what is so before the action and stands in a condition on
    it. Whether the rest of the condition holds does not matter, so that `next_to` and `!=` in it
    are not looked at.
    """
    if transition is None:
        return _constants(map(Literal.parse, goal))
    action = Literal.parse(transition.action)
    before = frozenset(map(Literal.parse, transition.before))
    changed = before ^ frozenset(map(Literal.parse, transition.after))
    facts = Facts(before)
    in_conditions = (
        met
        for condition in _conditions(domain).get(action.name, ())
        for met in condition.heads(action.arguments, facts)
    )
    return _constants([action, *map(Literal.parse, goal), *changed, *in_conditions])


def _constants(literals: Iterable[Literal]) -> frozenset[str]:
    return frozenset(constant for literal in literals for constant in literal.arguments)


@lru_cache(_DOMAINS)
def _conditions(domain: CoarseDomain) -> Mapping[str, Sequence[Pattern]]:
    """The fluent literals in conditions on coarse actions, by the action's name; it is given."""
    found: dict[str, list[Pattern]] = defaultdict(list)
    signature = domain.coarse_signature
    for law in domain.coarse.each(syntax.ExecutabilityCondition):
        domains = variable_domains(law, signature)
        for literal in roles.literals(law.body):
            declared = signature.symbols.get(literal.atom.name)
            if declared is not None and declared.kind in roles.FLUENTS:
                for action in law.actions:
                    pattern = Pattern(domains, [literal], NOTHING, action.args, literal)
                    found[action.name].append(pattern)
    return found


def zoom(
    source: syntax.Source, refinement: Refinement, constants: Collection[str]
) -> syntax.Source:
    """A description of the refinement restricted to relevant constants and their components.

    D_c(T, G) is that of `coarse`, D_f(T, G) that of `strong`, and without the theory of
    observation that of `weak`.
    """
    kept = fine_constants(refinement, constants).union(constants)
    restricted = restrict(source, refinement.constants - kept)
    return _commented(source, _writable(restricted))


def fine_constants(refinement: Refinement, constants: Collection[str]) -> frozenset[str]:
    """The components of the relevant constants."""
    return frozenset(part for whole in constants for part in refinement.components[whole])


def fine_goal(
    refinement: Refinement, transition: Transition, constants: Collection[str]
) -> tuple[Literals, Literals]:
    """The fine goal of a transition, as coarse literals: its effects, and what it leaves as it is.

    Together they are its second state, restricted to the relevant constants. Bridge axioms define
    coarse fluents in D_f, so that the counterpart of the state is the state itself;
    `Refinement.counterpart` gives the fine literals that make a literal of it true.
    """
    about, changed = frozenset(constants), transition.before ^ transition.after
    fluents = (f for f in refinement.description.inertial if about.issuperset(f.arguments))
    literals = [f if f in transition.after else f.complement for f in fluents]
    effects = tuple(each for each in literals if each.atom in changed)
    return effects, tuple(each for each in literals if each.atom not in changed)


def _writable(source: syntax.Source) -> list[syntax.Statement]:
    """The statements without sorts that are empty now, and without all that speaks of them."""
    signature = signature_of(source, Problems(source.file))
    sorts = {sort for sort, members in signature.sorts.items() if members}
    symbols = signature.symbols.items()
    known = sorts | {name for name, own in symbols if all(s.name in sorts for s in own.sorts)}
    return [
        _with_parts(statement, sorts)
        for statement in source.statements
        if _names(statement) <= known and all(variable_domains(statement, signature).values())
    ]


def _names(statement: syntax.Statement) -> set[str]:
    """The sorts and symbols that a statement is about; the one that it defines or declares."""
    if isinstance(statement, syntax.SortDefinition | syntax.Declaration):
        return {statement.name}
    return {use.atom.name for use in roles.scope(statement)}


def _with_parts(statement: syntax.Statement, sorts: set[str]) -> syntax.Statement:
    """A definition of a sort with those of the sorts that it names; others as they are."""
    if not isinstance(statement, syntax.SortDefinition):
        return statement
    parts = (p for p in statement.parts if isinstance(p, tuple) or p.name in sorts)
    return replace(statement, parts=tuple(parts))


def _commented(source: syntax.Source, kept: Sequence[syntax.Statement]) -> syntax.Source:
    """The source with these statements, the comments behind them, and the headings above."""
    starts = [statement.place.line for statement in kept]
    lines = {line for s in kept for line in range(s.place.line, s.last_line + 1)}
    alone = [comment.line for comment in source.comments if comment.alone]
    ends = dict(zip(alone, [*alone[1:], len(source.text)], strict=True))
    comments = tuple(
        comment
        for comment in source.comments
        if comment.line in lines
        or (comment.alone and any(comment.line < start < ends[comment.line] for start in starts))
    )
    return replace(source, statements=tuple(kept), comments=comments)
