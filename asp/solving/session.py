"""Multi-shot solving: a program grounded once, asked by assumptions and externals."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from functools import lru_cache

import clingo
from clingo import Symbol

from asp.solving.clock import preparation
from asp.solving.signals import undisturbed
from asp.solving.solver import fact, ground, theory

State = frozenset[str]
"""A complete state of a domain, as the set of its true fluents."""


class Session:
    """A domain with one theory, grounded once and asked many times.

    `parts` are those of the theory beside its base. Atoms are looked up as solver literals.
    """

    def __init__(
        self,
        program: str,
        theory_name: str,
        fluents: Sequence[str],
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
            self._literals[key] = None if atom is None else atom.literal
        return self._literals[key]

    def holds(self, fluent: str, step: int) -> int | None:
        """The solver literal of holds(fluent,step), or None where it can never hold."""
        return self.literal("holds", fluent, step)

    def assume_state(self, state: State, step: int) -> list[int] | None:
        """Assumptions that make the state that of the step; None where it is none."""
        assumptions = []
        for fluent in self._fluents:
            literal = self.holds(fluent, step)
            if literal is not None:
                assumptions.append(literal if fluent in state else -literal)
            elif fluent in state:
                return None
        return assumptions

    def state(self, model: clingo.Model, step: int) -> State:
        """The state of a step in a model."""
        return frozenset(
            fluent
            for fluent in self._fluents
            if (literal := self.holds(fluent, step)) is not None and model.is_true(literal)
        )

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


@lru_cache(maxsize=1_000)
def goal_externals(goal: tuple[str, ...]) -> tuple[Symbol, ...]:
    """wanted(F) and unwanted(F) for the literals of a goal."""
    return tuple(
        fact("unwanted", literal[1:]) if literal.startswith("-") else fact("wanted", literal)
        for literal in goal
    )
