"""Functions: fluents of which the laws allow one value per tuple of the other arguments."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import TypeVar

from asp.language import syntax
from asp.language.literals import Fluent
from asp.language.signature import Signature

T = TypeVar("T")


@dataclass(frozen=True)
class Function:
    """A fluent with at most one value in one of its places; `total`: with exactly one.

    `f(X, V1)` and `f(X, V2)` exclude each other where the values V1, V2 at `place` differ.
    """

    place: int
    total: bool

    def others(self, items: Sequence[T]) -> list[T]:
        """What stands in the other places, of one item per place."""
        return [item for place, item in enumerate(items) if place != self.place]


def functions(source: syntax.Source, signature: Signature) -> dict[str, Function]:
    """The inertial fluents that are functions, by name.

    A fluent is one by a law `-f(X, V2) if f(X, V1), V1 != V2`. It is total if the description says
    that initially it holds for some value, and nothing else makes it false.
    """
    found: dict[str, Function] = {}
    for law in source.each(syntax.StateConstraint):
        place = excluding_place(law)
        if place is not None and signature.symbols[law.head.atom.name].kind == "inertial":
            name = law.head.atom.name
            found.setdefault(name, Function(place, _is_total(name, place, source)))
    return found


def subject(fluent: Fluent, known: Mapping[str, Function]) -> tuple[str, ...] | None:
    """The total function and its arguments that a fluent gives a value; None if it is of none."""
    function = known.get(fluent.name)
    if function is None or not function.total:
        return None
    return (fluent.name, *function.others(fluent.arguments))


def excluding_place(law: syntax.Statement) -> int | None:
    """The place of the values that a law `-f(X, V2) if f(X, V1), V1 != V2` keeps apart, or None."""
    match law:
        case syntax.StateConstraint(
            head=syntax.Literal(head, False),
            body=(syntax.Literal(body, True), syntax.Comparison(left, right, False))
            | (syntax.Comparison(left, right, False), syntax.Literal(body, True)),
        ) if head.name == body.name and schematic(head) and schematic(body):
            pairs = [{a.name, b.name} for a, b in zip(head.args, body.args, strict=True)]
            apart = [place for place, names in enumerate(pairs) if len(names) == 2]
            sides = {left.name, right.name}
            return apart[0] if [pairs[place] for place in apart] == [sides] else None
    return None


def schematic(atom: syntax.Atom) -> bool:
    """Whether an atom has different variables for its arguments."""
    return len({term.name for term in atom.args if term.is_variable}) == len(atom.args)


def _is_total(name: str, place: int, source: syntax.Source) -> bool:
    given = any(
        statement.fluent.name == name
        and schematic(statement.fluent)
        and statement.fluent.args[place].name == statement.variable.name
        for statement in source.each(syntax.InitiallyStatement)
    )
    denied = any(
        law.head.atom.name == name and not law.head.positive and excluding_place(law) != place
        for law in source.statements
        if isinstance(law, syntax.CausalLaw | syntax.StateConstraint)
    )
    return given and not denied
