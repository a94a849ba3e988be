"""The states of a domain, by matching its constraints against the atoms that are true.

A state is an integer: bit i is set where the description's i-th fluent is true.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import replace
from functools import lru_cache
from pathlib import Path

from asp.language import Description, Signature, ground_description, syntax
from asp.language import literals as text
from testbed.world.closure import UnknownFluentError
from testbed.world.errors import StateError
from testbed.world.matched.change import Change
from testbed.world.matched.facts import (
    Facts,
    GroundAtom,
    GroundLiteral,
    atom_of_text,
    text_of,
)
from testbed.world.matched.laws import Instance, Laws

_REMEMBERED = 256


class SparseStates:
    """The complete sets of literals closed under the constraints, and what is true in them.

    `description` says all but the dynamic laws: these have too many instances.
    """

    def __init__(self, source: syntax.Source, signature: Signature, name: str = "") -> None:
        self.description = _declared(source, signature, name or Path(source.file).stem)
        self.fluents: tuple[str, ...] = self.description.fluents
        self._atoms = tuple(map(atom_of_text, self.fluents))
        self._numbers = {atom: number for number, atom in enumerate(self._atoms)}
        self._defined = frozenset(map(text.name, self.description.defined))
        self.signature = signature
        self.statics = Facts(map(atom_of_text, self.description.statics))
        self._laws = Laws(source, signature, self.statics)
        self.facts = lru_cache(_REMEMBERED)(self._decode)

    def state(self, literals: Iterable[str]) -> int:
        """The initial state of these literals; a fluent left out is false unless it follows.

        Raises StateError where a fluent is unknown, the literals contradict each other or a state
        constraint, describe no or several states, or leave out what an initial state must have.
        """
        given = list(literals)
        outcomes = self._described(given).outcomes()
        states = [s for s in (self._changed(0, o) for o in outcomes) if self.is_state(s)]
        if len(states) != 1:
            found = "several states agree" if states else "no state of the domain agrees"
            raise StateError(f"{found} with {self._text(map(self._literal, given))}")
        self._check_initial(states[0])
        return states[0]

    def adjusted(self, state: int, literals: Iterable[str]) -> tuple[int, ...]:
        """The states in which the literals hold, and else what holds in the given one if it can."""
        change = Change(self._laws, self._defined, self.facts(state), map(self._literal, literals))
        return tuple(sorted(self._changed(state, outcome) for outcome in change.outcomes()))

    def bare(self) -> int:
        """The state in which nothing is true but what must be."""
        return next(self._changed(0, outcome) for outcome in self._described([]).outcomes())

    def check_together(self, literals: Iterable[str]) -> None:
        """Raises StateError where the literals, with all that follows from them, are in no state.

        A sound test that takes no search: what passes it may still be in no state.
        """
        self._described(list(literals))

    def _described(self, literals: list[str]) -> Change:
        """What the literals make of a state in which nothing is true."""
        try:
            given = list(dict.fromkeys(map(self._literal, literals)))
        except UnknownFluentError as error:
            raise StateError(str(error)) from None
        twice = [(atom, sign) for atom, sign in given if (atom, not sign) in given]
        if twice:
            raise StateError(f"contradiction between {self._text(twice)}")
        change = Change(self._laws, self._defined, self.facts(0), given, self._seeds())
        broken = change.conflict()
        if broken is not None:
            raise StateError(self._breach(broken))
        return change

    def _breach(self, law: Instance) -> str:
        conflict = self._text([*law.body, (law.head[0], not law.head[1])])
        constraint = f"{text_of(law.head)} if {self._text(law.body)}".removesuffix(" if ")
        return f"{conflict} cannot be together: the constraint is {constraint}"

    def _seeds(self) -> list[GroundLiteral]:
        """What follows from nothing being true."""
        found: list[GroundLiteral] = []

        def keep(instance: Instance) -> bool:
            found.append(instance.head)
            return False

        for pattern in self._laws.groundless:
            pattern.search([], self.facts(0), keep)
        return found

    def _check_initial(self, state: int) -> None:
        facts = self.facts(state)
        for some in self.description.initially:
            if not any(facts.may_hold(atom_of_text(option)) for option in some):
                raise StateError(f"an initial state needs {' or '.join(some)}")

    def is_state(self, state: int) -> bool:
        """Whether the set of true fluents is closed under constraints and definitions."""
        facts = self.facts(state)

        def broken(instance: Instance) -> bool:
            atom, positive = instance.head
            return facts.may_hold(atom) != positive

        laws = self._laws.constraints
        return not any(p.search([], facts, broken) for p in laws) and self._founded(facts)

    def _founded(self, facts: Facts) -> bool:
        """Whether each true defined fluent is derived, in the end from none of its kind."""
        true = {atom for name in self._defined for atom in facts.named(name)}
        bodies: list[tuple[GroundAtom, list[GroundAtom]]] = []

        def keep(instance: Instance) -> bool:
            needs = [atom for atom, positive in instance.body if positive and atom in true]
            bodies.append((instance.head[0], needs))
            return False

        for atom in true:
            for pattern in self._laws.supports.get((atom[0], True), ()):
                pattern.search([atom], facts, keep)
        derived: set[GroundAtom] = set()
        grew = True
        while grew:
            more = {head for head, needs in bodies if derived.issuperset(needs)} - derived
            grew = bool(more)
            derived |= more
        return derived == true

    def literals(self, state: int) -> tuple[str, ...]:
        """Every fluent of the state as a literal, in the order of the fluents."""
        return tuple(
            fluent if state >> number & 1 else "-" + fluent
            for number, fluent in enumerate(self.fluents)
        )

    def true_atoms(self, state: int) -> tuple[str, ...]:
        """The fluents that are true in the state, in their order."""
        return tuple(self.fluents[number] for number in _bits(state))

    def holds(self, state: int, literal: str) -> bool:
        """Whether the literal holds. Raises UnknownFluentError."""
        return self.satisfies(state, (literal,))

    def satisfies(self, state: int, literals: Iterable[str]) -> bool:
        """Whether all the literals hold. Raises UnknownFluentError."""
        read = [self._literal(literal) for literal in literals]
        return all(bool(state >> self._numbers[atom] & 1) == positive for atom, positive in read)

    def _literal(self, literal: str) -> GroundLiteral:
        atom = atom_of_text(literal)
        if atom not in self._numbers:
            raise UnknownFluentError(f"{text.atom(literal)} is not a fluent of the domain")
        return atom, text.is_positive(literal)

    def _decode(self, state: int) -> Facts:
        return Facts(self._atoms[number] for number in _bits(state))

    def _changed(self, state: int, values: Mapping[GroundAtom, bool]) -> int:
        """The state with these values of atoms."""
        for atom, true in values.items():
            bit = 1 << self._numbers[atom]
            state = state | bit if true else state & ~bit
        return state

    def _render(self, literals: Iterable[GroundLiteral]) -> tuple[str, ...]:
        """Literals as text in the order of the fluents, of a pair the positive one first."""
        ordered = sorted(set(literals), key=lambda lit: (self._numbers[lit[0]], not lit[1]))
        return tuple(map(text_of, ordered))

    def _text(self, literals: Iterable[GroundLiteral]) -> str:
        return ", ".join(self._render(literals))


def _bits(state: int) -> Iterator[int]:
    """The numbers of the set bits, ascending."""
    while state:
        low = state & -state
        yield low.bit_length() - 1
        state ^= low


def _declared(source: syntax.Source, signature: Signature, name: str) -> Description:
    """The ground description without the laws about fluents."""
    laws = (syntax.CausalLaw, syntax.ExecutabilityCondition, syntax.TriggerStatement)
    kept = tuple(
        s for s in source.statements if not isinstance(s, laws) and not _about_fluents(s, signature)
    )
    return ground_description(replace(source, statements=kept), signature, name)


def _about_fluents(statement: syntax.Statement, signature: Signature) -> bool:
    if not isinstance(statement, syntax.StateConstraint):
        return False
    return signature.symbols[statement.head.atom.name].kind != "static"
