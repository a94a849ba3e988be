"""What an initial state is assumed to be, in as few words as its constraints allow."""

from collections.abc import Iterable

from asp.language import Literal
from asp.reasoning.knowledge import Knowledge
from asp.solving import fact, ground, is_satisfiable, theory


def beyond_observed(
    knowledge: Knowledge, observed: Iterable[Literal], assumed: Iterable[Literal]
) -> tuple[Literal, ...]:
    """The assumed literals of step 0 that follow neither from observed ones nor from each other.

    What follows is true in every initial state that has the others. True fluents are kept before
    false ones: where a thing is decides where it is not. Raises LimitError.
    """
    given = (*knowledge.start, fact("current_step", 0))
    control = ground([knowledge.program, theory("conflict")], {"n": 0}, given)

    def assumption(literal: Literal) -> int:
        atom = control.symbolic_atoms[fact("holds", literal.atom, 0)]
        return 0 if atom is None else atom.literal if literal.is_positive else -atom.literal

    known = [number for literal in observed if (number := assumption(literal))]
    kept = []
    for literal in sorted(assumed, key=lambda each: not each.is_positive):
        number = assumption(literal)
        if is_satisfiable(control, [*known, -number]):
            known.append(number)
            kept.append(literal)
    return tuple(sorted(kept))
