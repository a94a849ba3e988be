"""The instances of statements over the members of their variables' sorts, and the statics."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass
from itertools import product

from asp.language import syntax
from asp.language.description import Literals
from asp.language.literals import Literal
from asp.language.signature import Signature
from asp.language.variable_sorts import variable_domains

Binding = Mapping[str, str]


@dataclass(frozen=True)
class Instances:
    """The instances that the statics and comparisons of their bodies allow.

    A positive static holds if it is among the known ones, a negated one if it is not among the
    assumed ones; where both are all that is true (`instances_of`) this is the closed world.
    """

    source: syntax.Source
    signature: Signature
    known_statics: frozenset[Literal]
    assumed_statics: frozenset[Literal]

    def of(self, statement: syntax.Statement) -> Iterator[tuple[Binding, Literals]]:
        """The bindings that the statics and comparisons allow, with what is left of the body."""
        for binding in self.bindings(statement):
            body = self.evaluate(getattr(statement, "body", ()), binding)
            if body is not None:
                yield binding, body

    def bindings(self, statement: syntax.Statement) -> Iterator[Binding]:
        domains = variable_domains(statement, self.signature)
        for values in product(*domains.values()):
            yield dict(zip(domains, values, strict=True))

    def evaluate(self, body: Iterable[syntax.Condition], binding: Binding) -> Literals | None:
        """The fluent literals of a body, or None if a static or a comparison fails."""
        kept = []
        for condition in body:
            if isinstance(condition, syntax.Comparison):
                same = value_of(condition.left, binding) == value_of(condition.right, binding)
                if same != condition.equal:
                    return None
            elif self._is_static(condition):
                if not self._static_holds(condition, binding):
                    return None
            else:
                kept.append(literal_of(condition, binding))
        return tuple(dict.fromkeys(kept))

    def _is_static(self, literal: syntax.Literal) -> bool:
        name = literal.atom.name
        return name in self.signature.sorts or self.signature.symbols[name].kind == "static"

    def _static_holds(self, literal: syntax.Literal, binding: Binding) -> bool:
        if literal.atom.name in self.signature.sorts:
            return (
                value_of(literal.atom.args[0], binding) in self.signature.sorts[literal.atom.name]
            )
        if literal.positive:
            return atom_of(literal.atom, binding) in self.known_statics
        return atom_of(literal.atom, binding) not in self.assumed_statics

    def on_statics(self, law: syntax.StateConstraint) -> bool:
        return self._is_static(law.head)

    def static_laws(self) -> list[syntax.StateConstraint]:
        return [law for law in self.source.each(syntax.StateConstraint) if self.on_statics(law)]

    def closed_statics(self, assumed: frozenset[Literal]) -> frozenset[Literal]:
        """The least set with the facts that is closed under the constraints on statics.

        A negated static in a body holds where the static is not among the assumed ones.
        """
        closed = {
            atom_of(fact.literal.atom, binding)
            for fact in self.source.each(syntax.Fact)
            for binding in self.bindings(fact)
        }
        laws = self.static_laws()
        grew = True
        while grew:
            now = Instances(self.source, self.signature, frozenset(closed), assumed)
            derived = {
                atom_of(law.head.atom, binding) for law in laws for binding, _ in now.of(law)
            }
            grew = not derived <= closed
            closed |= derived
        return frozenset(closed)


def static_truth(
    source: syntax.Source, signature: Signature
) -> tuple[frozenset[Literal], frozenset[Literal]]:
    """The statics that are true, and those that the laws leave open (through their own negation).

    The alternating fixpoint: what is surely true narrows down what may be, and the other way round.
    """
    instances = Instances(source, signature, frozenset(), frozenset())
    true: frozenset[Literal] = frozenset()
    while True:
        possible = instances.closed_statics(true)
        surer = instances.closed_statics(possible)
        if surer == true:
            return true, possible - true
        true = surer


def instances_of(source: syntax.Source, signature: Signature) -> Instances:
    """The instances in the closed world of the description's statics."""
    statics, _ = static_truth(source, signature)
    return Instances(source, signature, statics, statics)


def value_of(term: syntax.Term, binding: Binding) -> str:
    return binding.get(term.name, term.name)


def atom_of(atom: syntax.Atom, binding: Binding) -> Literal:
    return Literal.of(atom.name, [value_of(term, binding) for term in atom.args])


def literal_of(literal: syntax.Literal, binding: Binding) -> Literal:
    atom = atom_of(literal.atom, binding)
    return atom if literal.positive else atom.complement
