"""Zooming: the part of both descriptions that a transition and a goal are about.

D_c(T, G) and D_f(T, G) are those of P 3.3, Definition 2, relCon(T, G) that of Definition 1.
"""

from __future__ import annotations

from collections.abc import Collection, Sequence
from dataclasses import dataclass, replace

from asp.language import (
    Problems,
    Signature,
    arguments,
    atom,
    complement,
    is_positive,
    restrict,
    signature_of,
    syntax,
    variable_domains,
)
from asp.language import variable_sorts as roles
from asp.refinement.facts import Facts
from asp.refinement.refinement import Refinement
from asp.refinement.relevance import Transition, relevant

__all__ = [
    "FineGoal",
    "Transition",
    "fine_constants",
    "fine_goal",
    "relevant",
    "zoom_coarse",
    "zoom_strong",
    "zoom_weak",
]


@dataclass(frozen=True)
class FineGoal:
    """What a fine plan for a transition has to reach, as coarse literals.

    `literals` is the state after the transition as far as it is about relevant constants,
    `effects` what of it the transition brings about. Bridge axioms tie them to fine fluents.
    """

    literals: tuple[str, ...]
    effects: tuple[str, ...]


def zoom_coarse(coarse: syntax.Source, constants: Collection[str]) -> syntax.Source:
    """D_c(T, G): the coarse description restricted to the relevant constants."""
    dropped = _signature(coarse).constants.difference(constants)
    return _commented(coarse, _writable(restrict(coarse, dropped)))


def zoom_weak(refinement: Refinement, constants: Collection[str]) -> syntax.Source:
    """D_f(T, G) without the theory of observation: the weak refinement about the components."""
    return _zoomed(refinement, refinement.weak_facts, constants)


def zoom_strong(refinement: Refinement, constants: Collection[str]) -> syntax.Source:
    """D_f(T, G): the strong refinement restricted to the components of the relevant constants."""
    return _zoomed(refinement, refinement.strong_facts, constants)


def _zoomed(refinement: Refinement, whole: Facts, constants: Collection[str]) -> syntax.Source:
    """A refined description about the components of the relevant constants.

    Most of its statements are ground facts; they are looked up by their constants, so that the
    time that this takes depends on what is relevant.
    """
    kept = fine_constants(refinement, constants).union(constants)
    rules = _writable(restrict(whole.rules, refinement.constants - kept))
    statements = sorted([*rules, *whole.about(kept)], key=lambda s: s.place.line)
    return _commented(whole.rules, statements)


def fine_constants(refinement: Refinement, constants: Collection[str]) -> frozenset[str]:
    """The components of the relevant constants."""
    return frozenset(part for whole in constants for part in refinement.components[whole])


def fine_goal(
    refinement: Refinement, transition: Transition, constants: Collection[str]
) -> FineGoal:
    """The fine goal of a transition: its second state, restricted to the relevant constants.

    Coarse fluents are defined in D_f, so that the counterpart of the state is the state itself;
    `Refinement.counterpart` gives the fine literals that make a literal of it true.
    """
    about = frozenset(constants)
    fluents = [
        fluent for fluent in refinement.description.inertial if about.issuperset(arguments(fluent))
    ]
    literals = tuple(
        fluent if fluent in transition.after else complement(fluent) for fluent in fluents
    )
    effects = (
        literal
        for literal in literals
        if is_positive(literal) != (atom(literal) in transition.before)
    )
    return FineGoal(literals, tuple(effects))


def _signature(source: syntax.Source) -> Signature:
    return signature_of(source, Problems(source.file))


def _writable(source: syntax.Source) -> list[syntax.Statement]:
    """The statements without sorts that are empty now, and without all that speaks of them."""
    signature = _signature(source)
    empty = {sort for sort, members in signature.sorts.items() if not members}
    known = {
        symbol
        for symbol, declaration in signature.symbols.items()
        if empty.isdisjoint(sort.name for sort in declaration.sorts)
    }.union(signature.sorts)
    return [
        _without_parts(statement, empty)
        for statement in source.statements
        if _is_writable(statement, empty, known) and _has_instances(statement, signature)
    ]


def _is_writable(statement: syntax.Statement, empty: set[str], known: set[str]) -> bool:
    if isinstance(statement, syntax.SortDefinition):
        return statement.name not in empty
    if isinstance(statement, syntax.Declaration):
        return statement.name in known
    names = {use.atom.name for use in roles.scope(statement)}
    return empty.isdisjoint(names) and names <= known


def _has_instances(statement: syntax.Statement, signature: Signature) -> bool:
    return all(variable_domains(statement, signature).values())


def _without_parts(statement: syntax.Statement, empty: set[str]) -> syntax.Statement:
    """A definition of a sort without the empty sorts that it names."""
    if not isinstance(statement, syntax.SortDefinition):
        return statement
    parts = (p for p in statement.parts if isinstance(p, tuple) or p.name not in empty)
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
