"""Multi-shot solving: a program grounded once, asked by assumptions and externals, in an order."""

from collections.abc import Iterable, Iterator, Sequence
from contextlib import contextmanager
from functools import lru_cache

import clingo
from clingo import Symbol

from asp.language import Fluent, Literal
from asp.solving.budget import preparation
from asp.solving.signals import undisturbed
from asp.solving.solver import fact, ground, is_satisfiable, literal_of, solving, theory

State = frozenset[Fluent]
"""A complete state of a domain, as the set of its true fluents."""


class Session:
    """A domain with one theory, grounded once and asked many times.

    `parts` are those of the theory beside its base. Atoms are looked up as solver literals.
    """

    def __init__(
        self,
        program: str,
        theory_name: str,
        fluents: Sequence[Fluent],
        facts: Iterable[Symbol],
        parts: Iterable[str] = (),
        **constants: int,
    ) -> None:
        with preparation():
            self.control = ground([program, theory(theory_name)], constants, facts, parts)
            # The first call prepares the solver, whatever it is asked.
            with undisturbed():
                self.control.solve()
        self._fluents = tuple(fluents)
        self._externals: set[Symbol] = set()
        self._literals: dict[tuple[int | str, ...], int | None] = {}

    def literal(self, predicate: str, *arguments: int | str) -> int | None:
        """The solver literal of an atom, or None where no rule derives it."""
        key = (predicate, *arguments)
        if key not in self._literals:
            atom = self.control.symbolic_atoms[fact(predicate, *arguments)]
            # It is 0 where the solver dropped the atom, since a fact contradicts it.
            self._literals[key] = None if atom is None else atom.literal or None
        return self._literals[key]

    def is_true(self, model: clingo.Model, predicate: str, *arguments: int | str) -> bool:
        """Whether an atom is true in a model."""
        literal = self.literal(predicate, *arguments)
        return literal is not None and model.is_true(literal)

    def holds(self, fluent: Fluent, step: int) -> int | None:
        """The solver literal of holds(fluent,step), or None where it can never hold."""
        return self.literal("holds", fluent, step)

    def assume_state(self, state: State, step: int) -> list[int] | None:
        """Assumptions that make the state that of the step; None where it is none."""
        return assumptions((self.holds(each, step), each in state) for each in self._fluents)

    def state(self, model: clingo.Model, step: int) -> State:
        """The state of a step in a model."""
        return frozenset(f for f in self._fluents if self.is_true(model, "holds", f, step))

    def switch_on(self, *atoms: Symbol) -> None:
        """Makes exactly these externals true; those of the call before become false again."""
        wanted = set(atoms)
        for atom in wanted - self._externals:
            if self.control.symbolic_atoms[atom] is None:
                raise ValueError(f"{atom} is no external of this program")
        with undisturbed():
            for atom in self._externals ^ wanted:
                self.control.assign_external(atom, atom in wanted)
            self._externals = wanted


def state_of(shown: Iterable[Symbol]) -> State:
    """The state that an answer set shows as next(F)."""
    return frozenset(literal_of(symbol.arguments[0]) for symbol in shown if symbol.name == "next")


def assumptions(wanted: Iterable[tuple[int | None, bool]]) -> list[int] | None:
    """Truth values of literals of the solver as assumptions; None where one cannot be true.

    A literal that is None belongs to an atom that no rule derives.
    """
    known = list(wanted)
    if (None, True) in known:
        return None
    return [each if truth else -each for each, truth in known if each is not None]


@lru_cache(maxsize=1_000)
def goal_externals(goal: tuple[Literal, ...]) -> tuple[Symbol, ...]:
    """wanted(F) and unwanted(F) for the literals of a goal."""
    return tuple(
        fact("wanted" if literal.is_positive else "unwanted", literal.atom) for literal in goal
    )


@contextmanager
def preferring(
    control: clingo.Control, assumptions: Sequence[int] = ()
) -> Iterator[clingo.Model | None]:
    """The first model in the order that `asp/theories/order.lp` states; None: there is none.

    It is to be read while this is open. Raises LimitError.
    """
    if control.is_conflicting:  # grounding alone found that there is none
        yield None
        return
    atoms = control.symbolic_atoms.by_signature("deciding", 1)
    groups = sorted((atom.symbol.arguments[0].number for atom in atoms), reverse=True)
    fixed = list(assumptions)
    for group in groups:
        if len(groups) > 1:  # a group that is alone is always on
            for other in groups:
                control.assign_external(fact("deciding", other), other == group)
        with solving(control, fixed) as model:
            if model is None or group == groups[-1]:
                yield model
                return
            fixed += _decided(control, group, model)


def _decided(control: clingo.Control, group: int, model: clingo.Model) -> Iterator[int]:
    """What a model decides in a group, as assumptions."""
    for decision in control.symbolic_atoms.by_signature("decision", 3):
        what, of, _ = decision.symbol.arguments
        atom = control.symbolic_atoms[what]
        if of.number == group and atom is not None:
            yield atom.literal if model.is_true(atom.literal) else -atom.literal


def core(
    control: clingo.Control, assumptions: Sequence[int], optional: Sequence[int]
) -> list[int] | None:
    """A smallest part of `optional` that has no answer set beside `assumptions`; None: all have.

    None of its members can be left out; where there is a choice it has the later ones of
    `optional`. Raises LimitError.
    """
    found: list[int] = []
    left = list(optional)
    if is_satisfiable(control, [*assumptions, *left]):
        return None
    while True:
        # The shortest rest that fails together with the literals found: without its
        # first member it would not fail, so that this member belongs to the core.
        low, high = 0, len(left)
        while low < high:
            middle = (low + high) // 2 + 1
            if is_satisfiable(control, [*assumptions, *found, *left[middle:]]):
                high = middle - 1
            else:
                low = middle
        if low == len(left):
            return found
        found.append(left[low])
        left = left[low + 1 :]
