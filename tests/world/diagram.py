"""The transition diagram of a translated program, by clingo."""

from collections.abc import Iterator, Sequence

import clingo

Atoms = frozenset[str]
Transition = tuple[Atoms, Atoms, Atoms]
"""The true fluents, the compound action, the true fluents after it."""

ANY_COMPOUND = "{ occurs(A,0) : action(A) }."
ONE_OF_EACH = """
    { occurs(A,0) : agent_action(A) } 1.
    { occurs(A,0) : exogenous_action(A) } 1.
"""


_SHOW = """
    #show occurs/2.
    #show holds/2.
"""


def states(program: str) -> set[Atoms]:
    """The true fluents of every state."""
    return {_atoms(model, "holds", 0) for model in _models(program, 0)}


def transitions(program: str, compounds: str) -> list[Transition]:
    """Every transition by a compound action that the rules `compounds` choose."""
    return [
        (_atoms(model, "holds", 0), _atoms(model, "occurs", 0), _atoms(model, "holds", 1))
        for model in _models(program + compounds, 1)
    ]


def _models(program: str, horizon: int) -> Iterator[Sequence[clingo.Symbol]]:
    control = clingo.Control(["--models=0", f"--const=n={horizon}"])
    control.add("base", [], program + _SHOW)
    control.ground([("base", [])])
    with control.solve(yield_=True) as handle:
        for model in handle:
            yield model.symbols(shown=True)


def _atoms(model: Sequence[clingo.Symbol], predicate: str, step: int) -> Atoms:
    """The first argument of each atom of the predicate at the step, as text."""
    return frozenset(
        str(symbol.arguments[0])
        for symbol in model
        if symbol.name == predicate and symbol.arguments[1].number == step
    )
