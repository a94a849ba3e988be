"""Zooming: the part of both descriptions that a transition and a goal are about.

D_c(T, G) and D_f(T, G) are those of P 3.3, Definition 2, relCon(T, G) that of Definition 1.
"""

from __future__ import annotations

from collections.abc import Collection, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from itertools import product

from asp.language import (
    Literal,
    Problems,
    Signature,
    arguments,
    name,
    restrict,
    signature_of,
    syntax,
    variable_domains,
)
from asp.language import variable_sorts as roles
from asp.refinement.refinement import Facts, Refinement


@dataclass(frozen=True)
class Transition:
    """A coarse transition <before, action, after>: the true fluents of two states, an action."""

    before: frozenset[str]
    action: str
    after: frozenset[str]


def relevant(coarse: syntax.Source, transition: Transition, goal: Iterable[str]) -> frozenset[str]:
    """relCon(T, G): the constants relevant to a transition or a goal (coarse literals)."""
    in_action = arguments(transition.action)
    in_goal = (constant for literal in goal for constant in arguments(literal))
    changed = transition.before ^ transition.after
    in_changes = (constant for fluent in changed for constant in arguments(fluent))
    return frozenset([*in_action, *in_goal, *in_changes, *_in_conditions(coarse, transition)])


def _in_conditions(coarse: syntax.Source, transition: Transition) -> Iterator[str]:
    """The constants of what is so before the action and stands in a condition on it (rule 4).

    Whether the rest of the condition holds does not matter, so that `next_to` and `!=` in it are
    not looked at.
    """
    signature = _signature(coarse)
    for law in coarse.each(syntax.ExecutabilityCondition):
        domains = variable_domains(law, signature)
        for action in law.actions:
            binding = _binding(action, transition.action, domains)
            if binding is None:
                continue
            for literal in roles.literals(law.body):
                declared = signature.symbols.get(literal.atom.name)
                if declared is not None and declared.kind in roles.FLUENTS:
                    yield from _met(literal, {**domains, **binding}, transition.before)


Domains = Mapping[str, tuple[str, ...]]


def _binding(action: syntax.Atom, given: str, domains: Domains) -> Domains | None:
    """The one value of each variable that makes the action the given one, if there are such."""
    if action.name != name(given):
        return None
    values: dict[str, tuple[str, ...]] = {}
    for term, value in zip(action.args, arguments(given), strict=True):
        possible = domains[term.name] if term.is_variable else (term.name,)
        if value not in values.get(term.name, possible):
            return None
        values[term.name] = (value,)
    return values


def _met(literal: syntax.Literal, domains: Domains, before: frozenset[str]) -> Iterator[str]:
    """The constants of the literal's instances that hold in the state."""
    terms = literal.atom.args
    variables = dict.fromkeys(term.name for term in terms if term.is_variable)
    for values in product(*(domains[variable] for variable in variables)):
        value = dict(zip(variables, values, strict=True))
        constants = [value.get(term.name, term.name) for term in terms]
        if (Literal.of(literal.atom.name, constants) in before) == literal.positive:
            yield from constants


@dataclass(frozen=True)
class FineGoal:
    """What a fine plan for a transition has to reach, as coarse literals.

    `literals` is the state after the transition as far as it is about relevant constants,
    `effects` what of it the transition brings about. Bridge axioms tie them to fine fluents.
    """

    literals: tuple[Literal, ...]
    effects: tuple[Literal, ...]


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
    literals = tuple(
        fluent if fluent in transition.after else fluent.complement
        for fluent in refinement.description.inertial
        if about.issuperset(fluent.arguments)
    )
    effects = (lit for lit in literals if lit.is_positive != (lit.atom in transition.before))
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
