"""The check that nothing is defined through its own negation.

A state constraint with a positive head defines that fluent. Where such definitions run in a
cycle with a negated body literal on it (`p if -p`, or `p if -q` with `q if -p`), the description
says no longer which states there are, and AL_d forbids it. A defined fluent, which is false where
nothing derives it, can also depend on its own negation by way of negative literals
(`d if -p` with `-p if -d`).
"""

from collections import defaultdict
from collections.abc import Hashable, Iterable, Iterator, Mapping, Sequence
from typing import TypeVar

from asp.language import syntax
from asp.language import variable_sorts as roles
from asp.language.errors import Problems
from asp.language.grounding import Instances, instance, static_truth
from asp.language.literals import Literal
from asp.language.signature import Signature

T = TypeVar("T", bound=Hashable)
Law = tuple[syntax.StateConstraint, Literal, Iterable[Literal]]
"""A state constraint with the head and the body of an instance, or with their names alone."""


def check_cycles(source: syntax.Source, signature: Signature, problems: Problems) -> None:
    """Reports each state constraint that closes a cycle through negation."""
    laws = list(source.each(syntax.StateConstraint))
    # Where the names alone close no cycle the instances, which larger sorts have more of, do not.
    by_name = [(law, _named(law.head), [*map(_named, roles.literals(law.body))]) for law in laws]
    if not any(_closing(by_name, signature)):
        return
    statics, open_statics = static_truth(source, signature)
    undecided = {static.name for static in open_statics}
    for law in laws:
        if law.head.atom.name in undecided:
            problems.report(
                law.place, f"'{law.head.atom.name}' is defined through its own negation"
            )
    instances = Instances(source, signature, statics)
    ground = [(law, instance(law.head, b), body) for law in laws for b, body in instances.of(law)]
    told: dict[syntax.StateConstraint, str] = {}
    for law, head, condition in _closing(ground, signature):
        told.setdefault(
            law, f"'{head}' is defined through its own negation by way of '{condition}'"
        )
    for law, message in told.items():
        problems.report(law.place, message)


def _named(literal: syntax.Literal) -> Literal:
    return Literal.of(literal.atom.name, (), literal.positive)


def _closing(
    laws: Sequence[Law], signature: Signature
) -> Iterator[tuple[syntax.StateConstraint, Literal, Literal]]:
    """The laws with a condition that makes the head depend on its own negation, and these two."""
    atoms: dict[Literal, set[Literal]] = defaultdict(set)
    literals: dict[Literal, set[Literal]] = defaultdict(set)
    for _, head, body in laws:
        literals[head].update(body)
        if head.is_positive:
            atoms[head].update(condition.atom for condition in body)
            if _is_defined(head, signature):
                literals[head.complement].add(head)
    for law, head, body in laws:
        for condition in body if head.is_positive else ():
            through_atoms = not condition.is_positive and head in reachable(condition.atom, atoms)
            if through_atoms or (
                _is_defined(head, signature) and head.complement in reachable(condition, literals)
            ):
                yield law, head, condition


def _is_defined(head: Literal, signature: Signature) -> bool:
    return signature.symbols[head.name].kind == "defined"


def reachable(start: T, graph: Mapping[T, set[T]]) -> set[T]:
    """The nodes to which the arcs of a graph lead from one of them, itself included."""
    found, stack = {start}, [start]
    while stack:
        new = graph.get(stack.pop(), set()) - found
        found |= new
        stack += new
    return found
