"""What is made once of a refinement, and serves every trial in it."""

from __future__ import annotations

from collections.abc import Mapping
from functools import cached_property
from typing import TypeVar

from agents.intentional.executor.laws import Effects, Tests
from asp.language import Function, atom, functions, name, subject, syntax
from asp.language import variable_sorts as roles
from asp.reasoning.fine_knowledge import IncrementalFineKnowledge
from asp.reasoning.fine_planning import (
    MOST_STEPS,
    FinePlanner,
    Horizons,
    fine_planner,
)
from asp.refinement import Refinement, shared_places
from asp.solving import Recent, preparation

MOST_REFINEMENTS = 16
"""Of how many refinements this is kept: those that were used last."""

T = TypeVar("T")


class prepared(cached_property[T]):  # noqa: N801 - as `cached_property` is written
    """A cached property whose making is preparation, which others can reuse."""

    def __get__(self, instance: object, owner: type | None = None) -> T:  # type: ignore[override]
        with preparation():
            return super().__get__(instance, owner)


class Means:
    """Planner, inferences and laws of one refinement, each made when it is first asked for."""

    def __init__(self, refinement: Refinement, horizons: Horizons) -> None:
        """`horizons` has the sessions of concrete plans, of other refinements too."""
        self._refinement = refinement
        self._horizons = horizons
        self._tests: dict[str, Tests] = {}

    @prepared
    def planner(self) -> FinePlanner:
        """Plans of concrete actions."""
        refinement = self._refinement
        return fine_planner(refinement.weak, refinement.weak_signature, self._horizons)

    @prepared
    def knowledge(self) -> IncrementalFineKnowledge:
        """Inferences from observations."""
        return IncrementalFineKnowledge(self._refinement)

    @prepared
    def effects(self) -> Effects:
        """The direct effects of concrete actions and of events."""
        return Effects(self._refinement)

    def tests(self, robot: str) -> Tests:
        """The tests of a robot."""
        if robot not in self._tests:
            with preparation():
                self._tests[robot] = Tests(self._refinement, robot)
        return self._tests[robot]

    @prepared
    def shares_places(self) -> bool:
        """Whether the components of anything are always in the same place."""
        return bool(shared_places(self._refinement.weak))

    @prepared
    def _functions(self) -> Mapping[str, Function]:
        return functions(self._refinement.weak, self._refinement.weak_signature)

    def is_value(self, fluent: str) -> bool:
        """Whether a fine fluent is one of several of which one always holds."""
        return subject(fluent, self._functions) is not None

    @prepared
    def unmagnified(self) -> frozenset[str]:
        """The inertial fluents without counterparts."""
        fluents, magnified = self._refinement.description.inertial, self._refinement.counterparts
        return frozenset(fluent for fluent in fluents if name(fluent) not in magnified)

    @prepared
    def carriers(self) -> frozenset[str]:
        """Those of the unmagnified fluents in constraints on fine fluents: these depend on them."""
        fine = frozenset(self._refinement.counterparts.values())
        named = {
            literal.atom.name
            for law in self._refinement.weak.each(syntax.StateConstraint)
            if law.head.atom.name in fine
            for literal in roles.literals(law.body)
        }
        return frozenset(fluent for fluent in self.unmagnified if name(fluent) in named)

    @prepared
    def conditions(self) -> Mapping[str, frozenset[str]]:
        """Of each coarse action, the fluents on which it depends whether it is possible."""
        found: dict[str, frozenset[str]] = {}
        for law in self._refinement.description.executability:
            for action in law.actions:
                found[action] = found.get(action, frozenset()).union(map(atom, law.body))
        return found

    @prepared
    def direct_effects(self) -> Mapping[str, frozenset[str]]:
        """Of each coarse action, what causal laws say that it may bring about."""
        found: dict[str, frozenset[str]] = {}
        for law in self._refinement.description.causal:
            found[law.action] = found.get(law.action, frozenset()) | {law.head}
        return found


_HORIZONS: Horizons = Horizons(MOST_STEPS)
_MEANS: Recent[Refinement, Means] = Recent(MOST_REFINEMENTS)


def means_of(refinement: Refinement) -> Means:
    """The means of a refinement, made when they are first asked for."""
    return _MEANS.get(refinement, lambda: Means(refinement, _HORIZONS))
