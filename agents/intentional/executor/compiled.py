"""What is made once of a refinement, and serves every trial in it."""

from __future__ import annotations

from collections.abc import Mapping
from functools import cached_property

from agents.intentional.executor.action_laws import (
    Effects,
    Tests,
    carriers,
    conditions,
    direct_effects,
)
from asp.language import Function, functions, name, subject
from asp.reasoning.fine_knowledge import Quick, Theory
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


class Means:
    """Planner, inferences and laws of one refinement, each made when it is first asked for."""

    def __init__(self, refinement: Refinement, horizons: Horizons) -> None:
        """`horizons` has the sessions of concrete plans, of other refinements too."""
        self._refinement = refinement
        self._horizons = horizons
        self._tests: dict[str, Tests] = {}

    @cached_property
    def planner(self) -> FinePlanner:
        """Plans of concrete actions."""
        refinement = self._refinement
        with preparation():
            return fine_planner(refinement.weak, refinement.weak_signature, self._horizons)

    @cached_property
    def quick(self) -> Quick:
        """Inferences where the laws are simple."""
        with preparation():
            return Quick(self._refinement)

    @cached_property
    def theory(self) -> Theory:
        """Inferences by `fine_inference.lp`."""
        with preparation():
            return Theory(self._refinement)

    @cached_property
    def effects(self) -> Effects:
        """The direct effects of concrete actions and of events."""
        with preparation():
            return Effects(self._refinement)

    def tests(self, robot: str) -> Tests:
        """The tests of a robot."""
        if robot not in self._tests:
            with preparation():
                self._tests[robot] = Tests(self._refinement, robot)
        return self._tests[robot]

    @cached_property
    def shares_places(self) -> bool:
        """Whether the components of anything are always in the same place."""
        with preparation():
            return bool(shared_places(self._refinement.weak))

    @cached_property
    def _functions(self) -> Mapping[str, Function]:
        with preparation():
            return functions(self._refinement.weak, self._refinement.weak_signature)

    def is_value(self, fluent: str) -> bool:
        """Whether a fine fluent is one of several of which one always holds."""
        return subject(fluent, self._functions) is not None

    @cached_property
    def plain(self) -> frozenset[str]:
        """The inertial fluents without counterparts."""
        fluents, magnified = self._refinement.description.inertial, self._refinement.counterparts
        with preparation():
            return frozenset(fluent for fluent in fluents if name(fluent) not in magnified)

    @cached_property
    def carriers(self) -> frozenset[str]:
        """Those of the plain fluents on which fluents with counterparts depend by laws."""
        plain = self.plain
        with preparation():
            return carriers(self._refinement) & plain

    @cached_property
    def conditions(self) -> Mapping[str, frozenset[str]]:
        """Of each coarse action, the fluents on which it depends whether it is possible."""
        with preparation():
            return conditions(self._refinement)

    @cached_property
    def direct_effects(self) -> Mapping[str, frozenset[str]]:
        """Of each coarse action, what causal laws say that it may bring about."""
        with preparation():
            return direct_effects(self._refinement)


_HORIZONS: Horizons = Horizons(MOST_STEPS)
_MEANS: Recent[Refinement, Means] = Recent(MOST_REFINEMENTS)


def means_of(refinement: Refinement) -> Means:
    """The means of a refinement, made when they are first asked for."""
    return _MEANS.get(refinement, lambda: Means(refinement, _HORIZONS))
