"""Executability conditions turned round: where an action is allowed, in terms of what is true."""

from __future__ import annotations

from collections.abc import Mapping

from asp.language import Function, syntax


def allowing(
    law: syntax.ExecutabilityCondition, functions: Mapping[str, Function]
) -> list[list[syntax.Condition]] | None:
    """Conjunctions one of which is true exactly where the law says nothing; None: no such.

    It has where all its variables are the action's, or values of total functions of these: then
    there is one instance, and one of its other conditions has to be false. `functions` are the
    fluents that are such, by name.
    """
    if len(law.actions) != 1 or not _all_different(law.actions[0]):
        return None
    known = {term.name for term in law.actions[0].args}
    values = [part for part in law.body if _is_value(part, known, functions)]
    guards = [part for part in law.body if part not in values]
    named_values = [_value(part, functions) for part in values]
    known.update(named_values)
    if len(set(named_values)) < len(values) or not guards:
        return None
    if not all(_is_open(guard, known) for guard in guards):
        return None
    return [[*values, _negated(guard)] for guard in guards]


def _is_value(part: syntax.Condition, known: set[str], functions: Mapping[str, Function]) -> bool:
    """Whether a condition only names the value of a total function of what is known."""
    if not isinstance(part, syntax.Literal) or not part.positive:
        return False
    function = functions.get(part.atom.name)
    if function is None or not function.total:
        return False
    value = part.atom.args[function.place]
    others = (term.name for n, term in enumerate(part.atom.args) if n != function.place)
    return value.is_variable and value.name not in known and known.issuperset(others)


def _value(part: syntax.Condition, functions: Mapping[str, Function]) -> str:
    assert isinstance(part, syntax.Literal)
    return part.atom.args[functions[part.atom.name].place].name


def _is_open(guard: syntax.Condition, known: set[str]) -> bool:
    """Whether a condition is negative, so that few instances make it false, and all is known."""
    if isinstance(guard, syntax.Comparison):
        terms: tuple[syntax.Term, ...] = (guard.left, guard.right)
        return not guard.equal and all(t.name in known or not t.is_variable for t in terms)
    return not guard.positive and all(
        term.name in known or not term.is_variable for term in guard.atom.args
    )


def _negated(guard: syntax.Condition) -> syntax.Condition:
    if isinstance(guard, syntax.Comparison):
        return syntax.Comparison(guard.left, guard.right, not guard.equal, guard.place)
    return syntax.Literal(guard.atom, not guard.positive)


def _all_different(atom: syntax.Atom) -> bool:
    names = [term.name for term in atom.args]
    return all(term.is_variable for term in atom.args) and len(set(names)) == len(names)
