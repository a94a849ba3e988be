"""The check that no fluent is defined through its own negation.

A state constraint with a positive head defines that fluent. Where such definitions run in a
cycle with a negated body literal on it (`p if -p`, or `p if -q` with `q if -p`), the description
says no longer which states there are, and AL_d forbids it.
"""

from __future__ import annotations

from collections.abc import Mapping

from asp import syntax
from asp.grounding import ground_law
from asp.literals import atom, is_positive
from asp.signature import Problems, Signature

Graph = Mapping[str, set[str]]


def check_cycles(source: syntax.Source, signature: Signature, problems: Problems) -> None:
    """Reports each state constraint that closes a cycle through negation."""
    graph: dict[str, set[str]] = {}
    negative: list[tuple[syntax.StateConstraint, str, str]] = []
    for law in source.each(syntax.StateConstraint):
        if not law.head.positive:
            continue
        for head, body in ground_law(law, source, signature):
            graph.setdefault(head, set()).update(map(atom, body))
            negative += [(law, head, atom(lit)) for lit in body if not is_positive(lit)]
    reported: set[syntax.StateConstraint] = set()
    for law, head, condition in negative:
        if law not in reported and head in _reachable(condition, graph):
            reported.add(law)
            problems.report(
                law.place, f"'{head}' is defined through its own negation by way of '-{condition}'"
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
