"""The first answer set in the order that `asp/theories/order.lp` states."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from contextlib import contextmanager

import clingo

from asp.solving.solver import fact, solving


@contextmanager
def preferring(
    control: clingo.Control, assumptions: Sequence[int] = ()
) -> Iterator[clingo.Model | None]:
    """The preferred model under assumptions, to be read while this is open; None: there is none.

    Raises LimitError.
    """
    if control.is_conflicting:  # grounding alone found that there is none
        yield None
        return
    fixed = list(assumptions)
    groups = _groups(control)
    for group in groups[:-1]:
        _decide(control, groups, group)
        with solving(control, fixed) as model:
            if model is None:
                yield None
                return
            fixed += _decided(control, group, model)
    _decide(control, groups, groups[-1])
    with solving(control, fixed) as model:
        yield model


def _groups(control: clingo.Control) -> list[int]:
    """The groups of decisions, in the order in which they are to be decided."""
    atoms = control.symbolic_atoms.by_signature("deciding", 1)
    return sorted((atom.symbol.arguments[0].number for atom in atoms), reverse=True)


def _decide(control: clingo.Control, groups: Sequence[int], group: int) -> None:
    """Switches on the levels of one group only; a group that is alone is always on."""
    if len(groups) > 1:
        for other in groups:
            control.assign_external(fact("deciding", other), other == group)


def _decided(control: clingo.Control, group: int, model: clingo.Model) -> Iterator[int]:
    """What a model decides in a group, as assumptions."""
    for decision in control.symbolic_atoms.by_signature("decision", 3):
        what, of, _ = decision.symbol.arguments
        atom = control.symbolic_atoms[what]
        if of.number == group and atom is not None:
            yield atom.literal if model.is_true(atom.literal) else -atom.literal
