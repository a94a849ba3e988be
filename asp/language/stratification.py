"""The check that nothing is defined through its own negation.

A state constraint with a positive head defines that fluent. Where such definitions run in a
cycle with a negated body literal on it (`p if -p`, or `p if -q` with `q if -p`), the description
says no longer which states there are, and AL_d forbids it. A defined fluent, which is false where
nothing derives it, can also depend on its own negation by way of negative literals
(`d if -p` with `-p if -d`).
"""

from __future__ import annotations

from collections.abc import Mapping

from asp.language import syntax
from asp.language import variable_sorts as roles
from asp.language.errors import Problems
from asp.language.grounding import instance, instances_of, static_truth
from asp.language.literals import Literal, atom, complement, is_positive, name
from asp.language.signature import Signature

Graph = Mapping[str, set[str]]


def check_cycles(source: syntax.Source, signature: Signature, problems: Problems) -> None:
    """Reports each state constraint that closes a cycle through negation."""
    _check_statics(source, signature, problems)
    atoms: dict[str, set[str]] = {}
    literals: dict[str, set[str]] = {}
    laws: list[tuple[syntax.StateConstraint, Literal, Literal]] = []
    instances = instances_of(source, signature)
    for law in source.each(syntax.StateConstraint):
        for binding, body in instances.of(law):
            head = instance(law.head, binding)
            literals.setdefault(head, set()).update(body)
            laws += [(law, head, condition) for condition in body]
            if is_positive(head):
                atoms.setdefault(head, set()).update(map(atom, body))
                if signature.symbols[name(head)].kind == "defined":
                    literals.setdefault(complement(head), set()).add(head)
    reported: set[syntax.StateConstraint] = set()
    for law, head, condition in laws:
        if law not in reported and _closes(head, condition, atoms, literals, signature):
            reported.add(law)
            problems.report(
                law.place, f"'{head}' is defined through its own negation by way of '{condition}'"
            )


def may_have_cycles(source: syntax.Source, signature: Signature) -> bool:
    """Whether names alone leave a cycle through negation possible; no: `check_cycles` finds none.

    It looks at laws, not at their instances, so that it takes no longer for larger sorts.
    """
    graph: dict[str, set[str]] = {}
    laws = list(source.each(syntax.StateConstraint))
    for law in laws:
        body = {_named(part) for part in law.body if isinstance(part, syntax.Literal)}
        graph.setdefault(_named(law.head), set()).update(body)
    for symbol, declaration in signature.symbols.items():
        if declaration.kind in ("defined", "static"):
            graph.setdefault("-" + symbol, set()).add(symbol)
    positive = {head: set(map(atom, body)) for head, body in graph.items() if is_positive(head)}
    for law in laws:
        head = law.head.atom.name
        for part in roles.literals(law.body if law.head.positive else ()):
            if not part.positive and head in _reachable(part.atom.name, positive):
                return True
            if "-" + head in _reachable(_named(part), graph) and "-" + head in graph:
                return True
    return False


def _named(literal: syntax.Literal) -> str:
    return ("" if literal.positive else "-") + literal.atom.name


def _closes(head: str, condition: str, atoms: Graph, literals: Graph, signature: Signature) -> bool:
    """Whether this condition of a law makes its head depend on its own negation."""
    if not is_positive(head):
        return False
    if not is_positive(condition) and head in _reachable(atom(condition), atoms):
        return True
    defined = signature.symbols[name(head)].kind == "defined"
    return defined and complement(head) in _reachable(condition, literals)


def _check_statics(source: syntax.Source, signature: Signature, problems: Problems) -> None:
    _, undecided = static_truth(source, signature)
    names = {name(static) for static in undecided}
    for law in source.each(syntax.StateConstraint):
        if law.head.atom.name in names:
            problems.report(
                law.place, f"'{law.head.atom.name}' is defined through its own negation"
            )


def _reachable(start: str, graph: Graph) -> set[str]:
    """Everything that the definition of `start` depends on, `start` included."""
    found = {start}
    stack = [start]
    while stack:
        for dependency in graph.get(stack.pop(), ()):
            if dependency not in found:
                found.add(dependency)
                stack.append(dependency)
    return found
