"""relCon(T, G): the constants that a transition and a goal are about (P 3.3, Definition 1)."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass
from itertools import product

from asp.language import Problems, arguments, name, signature_of, syntax, variable_domains
from asp.language import variable_sorts as roles


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
    signature = signature_of(coarse, Problems(coarse.file))
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
        fluent = f"{literal.atom.name}({','.join(constants)})" if constants else literal.atom.name
        if (fluent in before) == literal.positive:
            yield from constants
