"""Which constants a plan can do without, and which ones may stand for each other.

A set X of constants is *independent* of the rest where nothing that is true of X ever changes
anything else, except by standing in the way. Then a plan for a goal that does not mention X stays
one when the actions that mention X are left out, so that no shortest plan has any; and where
nothing of X stands in the way now, the shortest plans of the restricted domain are those of the
whole one.
"""

from __future__ import annotations

from collections.abc import Collection, Iterable, Mapping
from functools import cached_property
from itertools import pairwise

from asp.language import (
    Description,
    Literal,
    Literals,
    Signature,
    arguments,
    atom,
    complement,
    is_positive,
    named,
    syntax,
)


class Independence:
    """What can be left out of a description when planning in it."""

    def __init__(
        self, description: Description, source: syntax.Source, signature: Signature
    ) -> None:
        self._description = description
        self.classes = _interchangeable(source, signature)

    @cached_property
    def candidates(self) -> frozenset[str]:
        """The interchangeable constants each of which is independent of all others.

        What holds of one member of a class holds of all.
        """
        return frozenset(
            constant
            for members in self.classes
            if self._is_independent(members[0])
            for constant in members
        )

    def droppable(self, state: Collection[str], goal: Iterable[str]) -> frozenset[str]:
        """The candidates that the goal leaves alone and that nothing true makes an obstacle."""
        needed = {
            constant
            for literal in goal
            if not self._stays(literal, state)
            for constant in arguments(literal)
        }
        for fluent in self._obstacles.intersection(state):
            needed.update(arguments(fluent))
        return self.candidates - needed

    def _stays(self, literal: str, state: Collection[str]) -> bool:
        """Whether a literal is true, and stays so without actions that mention its candidate."""
        constants = self.candidates.intersection(arguments(literal))
        return _true(literal, state) and all(
            _true(head, state) or any(not _true(condition, state) for condition in own)
            for constant in constants
            for head, own in self._moving[constant]
        )

    @cached_property
    def _moving(self) -> Mapping[str, list[tuple[str, tuple[str, ...]]]]:
        """Of each candidate: what something else makes of it, and under what conditions on it."""
        found: dict[str, list[tuple[str, tuple[str, ...]]]] = {c: [] for c in self.candidates}
        laws: list[tuple[Literal, Literals, str]]
        laws = [(law.head, law.body, law.action) for law in self._description.causal]
        laws += [(law.head, law.body, "") for law in self._description.constraints]
        for head, body, action in laws:
            for constant in self.candidates.intersection(arguments(head)):
                own = tuple(literal for literal in body if constant in arguments(literal))
                if constant not in arguments(action) and (action or own != body):
                    found[constant].append((head, own))
        return found

    @cached_property
    def _obstacles(self) -> frozenset[str]:
        """Fluents of candidates that make actions on something else impossible when true."""
        agents = frozenset(self._description.agent_actions)
        return frozenset(
            literal
            for law in self._description.executability
            if agents.issuperset(law.actions)
            for literal in law.body
            if is_positive(literal)
            and any(
                not _mentions(constant, law.actions)
                for constant in self.candidates.intersection(arguments(literal))
            )
        )

    @cached_property
    def _hindered(self) -> Mapping[tuple[str, ...], set[str]]:
        """Of each condition, the actions that it makes impossible by itself."""
        found: dict[tuple[str, ...], set[str]] = {}
        for law in self._description.executability:
            if len(law.actions) == 1:
                found.setdefault(law.body, set()).add(law.actions[0])
        return found

    def _is_independent(self, constant: str) -> bool:
        description = self._description
        return (
            all(
                constant in arguments(law.head)
                for law in description.causal
                if constant in arguments(law.action) or _mentions(constant, law.body)
            )
            and all(
                constant in arguments(law.head) or self._is_harmless(constant, law.head, law.body)
                for law in description.constraints
                if _mentions(constant, law.body)
            )
            and not any(
                constant in arguments(literal) and literal.startswith("-")
                for law in description.executability
                if not _mentions(constant, law.actions)
                for literal in law.body
            )
        )

    def _is_harmless(self, constant: str, head: str, body: tuple[str, ...]) -> bool:
        """Whether a constraint from the constant to the rest only repeats what is so already.

        That is: one of its conditions on the constant comes true only by actions that are
        impossible unless the head holds before.
        """
        return any(
            constant in arguments(condition) and self._only_while(condition, head)
            for condition in body
        )

    def _only_while(self, condition: str, head: str) -> bool:
        description = self._description
        makers = {law.action for law in description.causal if law.head == condition}
        guarded = self._hindered.get((complement(head),), set())
        derived = any(law.head == condition for law in description.constraints)
        return not derived and makers <= guarded and atom(condition) in description.inertial


def symmetric_pairs(
    classes: Iterable[tuple[str, ...]], state: Collection[str], goal: Collection[str]
) -> tuple[tuple[str, str], ...]:
    """Neighbouring constants of a class of which the state and the goal say the same."""
    true, wanted = _profiles(state), _profiles(goal)
    nothing: frozenset[str] = frozenset()
    return tuple(
        (first, second)
        for members in classes
        for first, second in pairwise(members)
        if true.get(first, nothing) == true.get(second, nothing)
        and wanted.get(first, nothing) == wanted.get(second, nothing)
    )


def _profiles(literals: Collection[str]) -> Mapping[str, frozenset[str]]:
    """What is said of each constant, with a blank in its place."""
    said: dict[str, set[str]] = {}
    for literal in literals:
        constants = arguments(literal)
        for constant in constants:
            blanked = ",".join("_" if c == constant else c for c in constants)
            said.setdefault(constant, set()).add(f"{literal.partition('(')[0]}({blanked})")
    return {constant: frozenset(texts) for constant, texts in said.items()}


def _true(literal: str, state: Collection[str]) -> bool:
    return (atom(literal) in state) == is_positive(literal)


def _mentions(constant: str, literals: Iterable[str]) -> bool:
    return any(constant in arguments(literal) for literal in literals)


def _interchangeable(source: syntax.Source, signature: Signature) -> tuple[tuple[str, ...], ...]:
    """Classes of constants, in order of declaration, that no law or fact tells apart."""
    lawful = (syntax.CausalLaw, syntax.StateConstraint, syntax.ExecutabilityCondition, syntax.Fact)
    mentioned = {
        name
        for statement in source.statements
        if isinstance(statement, lawful)
        for name in named(statement)
    }
    classes: dict[frozenset[str], list[str]] = {}
    for constant in dict.fromkeys(m for members in signature.sorts.values() for m in members):
        if constant not in mentioned:
            sorts = frozenset(s for s, members in signature.sorts.items() if constant in members)
            classes.setdefault(sorts, []).append(constant)
    return tuple(tuple(members) for members in classes.values())
