"""What a trial at the fine resolution draws: where everything is at the start, and the goal."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Iterator, Mapping
from itertools import product

import numpy as np

from asp import literals
from asp.refinement import Refinement
from testbed.config.models import ExperimentConfig
from testbed.environment.fine import RandomStart, fine_world

Drawn = tuple[tuple[str, ...], tuple[str, ...]]


class Drawing:
    """Draws the trials of one level: what the configuration gives is not drawn."""

    def __init__(self, config: ExperimentConfig, refinement: Refinement) -> None:
        description = refinement.description
        self._world = fine_world(refinement)
        self._start = RandomStart(self._world, description.robots[0], config.draw.holding)
        self._goals = list(goals(config.draw.goal, description.sorts))
        self._initial, self._goal = config.initial, config.goal

    def trial(self, generator: np.random.Generator) -> Drawn:
        """The inertial atoms true at the start, and a goal that does not hold there."""
        given = self._initial
        state = self._start(generator) if given is None else self._world.state(given)
        true = frozenset(self._world.true_atoms(state))
        inertial = true.intersection(self._world.description.inertial)
        return tuple(sorted(inertial)), self._goal or self._open_goal(true, generator)

    def _open_goal(self, true: Collection[str], generator: np.random.Generator) -> tuple[str, ...]:
        """One of those that do not hold yet, if there is one."""
        open_goals = [goal for goal in self._goals if not holds(goal, true)] or self._goals
        return open_goals[int(generator.integers(len(open_goals)))]


def goals(
    patterns: Iterable[str], sorts: Mapping[str, tuple[str, ...]]
) -> Iterator[tuple[str, ...]]:
    """Every instance of literals with sorts for constants, one constant for each sort in them."""
    wanted = tuple(patterns)
    names = list(dict.fromkeys(sort for p in wanted for sort in literals.arguments(p)))
    for values in product(*(sorts[name] for name in names)):
        yield tuple(_instance(pattern, dict(zip(names, values, strict=True))) for pattern in wanted)


def _instance(pattern: str, values: Mapping[str, str]) -> str:
    name = pattern.partition("(")[0]
    return literals.ground(name, (values[sort] for sort in literals.arguments(pattern)))


def holds(goal: Iterable[str], true: Collection[str]) -> bool:
    """Whether all literals of a goal hold where these atoms are true."""
    return all((literals.atom(g) in true) == literals.is_positive(g) for g in goal)
