"""The states of a domain, compiled from its ground description (P 3.1.1).

A state is an integer: bit i is set where the description's i-th fluent is true.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from asp.language import Description
from testbed.world.closure import Closure, Rule, UnknownFluentError, Vocabulary
from testbed.world.errors import StateError


class StateSpace:
    """The complete sets of literals closed under the constraints, and what is true in them."""

    def __init__(self, description: Description) -> None:
        self.description = description
        self.fluents: tuple[str, ...] = description.fluents
        self._vocabulary = Vocabulary(self.fluents)
        mask, bit = self._vocabulary.mask, self._vocabulary.bit
        self._constraints = tuple(Rule(mask(c.body), bit(c.head)) for c in description.constraints)
        self._closure = Closure(self._vocabulary, self._constraints)
        inertial = mask(description.inertial)
        self._inertial_fluents = inertial
        self._inertial = inertial | self._vocabulary.complement(inertial)
        self._closed_world = self._vocabulary.complement(mask(description.defined))
        self._initially = tuple(mask(some) for some in description.initially)

    def state(self, literals: Iterable[str]) -> int:
        """The initial state of these literals; a fluent left out is false unless it follows.

        Raises StateError where a fluent is unknown, the literals contradict each other or a state
        constraint, describe no or several states, or leave out what an initial state must have.
        """
        facts = self._facts(literals)
        mentioned = facts | self._vocabulary.complement(facts)
        left_out = self._vocabulary.positive & ~mentioned
        models = self._closure.models(facts, self._vocabulary.complement(left_out))
        states = [state for state in map(self._true, models) if self.is_state(state)]
        if len(states) != 1:
            found = "several states agree" if states else "no state of the domain agrees"
            raise StateError(f"{found} with {self._text(facts)}")
        self._check_initial(states[0])
        return states[0]

    def check_together(self, literals: Iterable[str]) -> None:
        """Raises StateError where the literals, with all that follows from them, are in no state.

        A sound test that takes no search: what passes it may still be in no state.
        """
        self._facts(literals)

    def _facts(self, literals: Iterable[str]) -> int:
        try:
            facts = self._vocabulary.mask(literals)
        except UnknownFluentError as error:
            raise StateError(str(error)) from None
        if not self._vocabulary.consistent(facts):
            twice = facts & self._vocabulary.complement(facts)
            raise StateError(f"contradiction between {self._text(twice)}")
        self._check_constraints(facts)
        return facts

    def _check_constraints(self, facts: int) -> None:
        known = self._closure.consequences(facts)
        if self._vocabulary.consistent(known):
            return
        denied = self._vocabulary.complement(known)
        law = next(r for r in self._constraints if not r.body & ~known and r.head & denied)
        conflict = self._text(law.body | self._vocabulary.complement(law.head))
        constraint = f"{self._text(law.head)} if {self._text(law.body)}".removesuffix(" if ")
        raise StateError(f"{conflict} cannot be together: the constraint is {constraint}")

    def _check_initial(self, state: int) -> None:
        for some in self._initially:
            if not state & some:
                options = " or ".join(self._vocabulary.render(some))
                raise StateError(f"an initial state needs {options}")

    def is_state(self, state: int) -> bool:
        """Whether the set of true fluents is closed under constraints and definitions."""
        return state in self._states_with(self._vocabulary.complete(state) & self._inertial)

    def states(self) -> Iterator[int]:
        """Every state of the domain, in a fixed order."""
        return self._choose(0, self._inertial_fluents)

    def initial_states(self) -> tuple[int, ...]:
        """The states that have all that the description asks of an initial one, in that order."""
        return tuple(s for s in self.states() if all(s & some for some in self._initially))

    def _choose(self, chosen: int, undecided: int) -> Iterator[int]:
        """The states that extend the chosen literals by a value for each undecided fluent."""
        known = self._closure.consequences(chosen)
        if not self._vocabulary.consistent(known):
            return
        if not undecided:
            yield from self._states_with(chosen)
            return
        fluent = undecided & -undecided
        for literal in (fluent, self._vocabulary.complement(fluent)):
            yield from self._choose(chosen | literal, undecided ^ fluent)

    def _states_with(self, inertial: int) -> tuple[int, ...]:
        """The states with these inertial literals: defined fluents are derived, else false."""
        models = self._closure.models(inertial, self._closed_world)
        return tuple(sorted(self._true(m) for m in models if m & self._inertial == inertial))

    def literals(self, state: int) -> tuple[str, ...]:
        """Every fluent of the state as a literal, in the order of the fluents."""
        return self._vocabulary.render(self._vocabulary.complete(state))

    def true_atoms(self, state: int) -> tuple[str, ...]:
        """The fluents that are true in the state, in their order."""
        return self._vocabulary.render(state)

    def holds(self, state: int, literal: str) -> bool:
        """Whether the literal holds. Raises UnknownFluentError."""
        return bool(self._vocabulary.complete(state) & self._vocabulary.bit(literal))

    def satisfies(self, state: int, literals: Iterable[str]) -> bool:
        """Whether all the literals hold. Raises UnknownFluentError."""
        return not self._vocabulary.mask(literals) & ~self._vocabulary.complete(state)

    def _true(self, literals: int) -> int:
        return literals & self._vocabulary.positive

    def _text(self, literals: int) -> str:
        return ", ".join(self._vocabulary.render(literals))
