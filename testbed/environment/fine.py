"""A game at the fine resolution, made of a refinement, and its random beginnings."""

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from functools import partial
from itertools import product
from typing import Literal as Choice

import numpy as np

from asp.language import Fluent, Literal
from asp.refinement import Refinement, sensing_of
from testbed.environment.core import Core, DrawGoal
from testbed.environment.execution import Execution, Statistics
from testbed.environment.rules import Rules
from testbed.search import coarse_problem
from testbed.world import World, world_of

Pace = Choice["concrete", "abstract"]
"""When exogenous actions may happen: at each step, or only beside an action of the robot that
changes what holds at the coarse resolution."""


def fine_core(
    refinement: Refinement,
    rules: Rules,
    statistics: Statistics | None = None,
    pace: Pace = "concrete",
    initial: Sequence[int] | None = None,
    draw_goal: DrawGoal | None = None,
    holding: float = 0.2,
) -> Core:
    """A game whose robot acts and tests at the fine resolution.

    The goal may have literals of both resolutions. Without `initial` a game begins in a random
    state (`RandomStart`, with its probability of `holding`), and with `draw_goal` it has a goal of
    its own. Raises UnknownFluentError for the goal, ValueError for the statistics.
    """
    world = world_of(refinement)
    robot = refinement.description.robots[0]
    coarse = refinement.coarse_signature.symbols if pace == "abstract" else None
    execution = Execution(world, robot, sensing_of(refinement), statistics or {}, coarse)
    starts = RandomStart(world, robot, holding) if initial is None else initial
    pose = partial(coarse_problem, refinement)
    return Core(world, rules, starts, execution, draw_goal, pose)


@dataclass(eq=False)
class RandomStart:
    """Draws an initial state: a value for each thing that must have one, as `initially` says.

    With probability `holding` the robot stands in a relation, such as holding, to one of the things
    that must be somewhere. What follows from that is not drawn again.
    """

    world: World
    robot: str
    holding: float = 0.2

    def __post_init__(self) -> None:
        groups = self.world.description.initially
        placed = {fluent for some in groups for fluent in some}
        things = {some[0].arguments[0] for some in groups if some[0].arguments}
        self._relations = [
            fluent
            for fluent in self.world.description.inertial
            if fluent not in placed and _relates(self.robot, fluent, things)
        ]

    def __call__(self, random: np.random.Generator) -> int:
        """The state. Everything drawn comes from the generator."""
        state = self.world.bare()
        if self._relations and random.random() < self.holding:
            state = self._with(state, [self._relations[int(random.integers(len(self._relations)))]])
        for some in self.world.description.initially:
            if not any(self.world.holds(state, fluent) for fluent in some):
                state = self._with(state, [some[int(n)] for n in random.permutation(len(some))])
        return state

    def _with(self, state: int, options: Sequence[Literal]) -> int:
        """A state in which the first of the options holds that can."""
        found = (self.world.adjusted(state, (option,)) for option in options)
        return next((states[0] for states in found if states), state)


def _relates(robot: str, fluent: Fluent, things: set[str]) -> bool:
    others = {constant for constant in fluent.arguments if constant != robot}
    return robot in fluent.arguments and bool(others) and others <= things


class RandomGoal:
    """Draws an instance of the patterns that does not hold yet; any, if all hold.

    Equal sorts in the patterns stand for one constant.
    """

    def __init__(
        self, world: World, patterns: Iterable[Literal], sorts: Mapping[str, tuple[str, ...]]
    ) -> None:
        self._world = world
        given = tuple(patterns)
        drawn = list(dict.fromkeys(sort for pattern in given for sort in pattern.arguments))
        combinations = product(*(sorts[sort] for sort in drawn))
        chosen = [dict(zip(drawn, values, strict=True)) for values in combinations]
        self._goals = [tuple(pattern.renamed(values) for pattern in given) for values in chosen]

    def __call__(self, state: int, random: np.random.Generator) -> tuple[Literal, ...]:
        """The goal of a game that begins in the state."""
        unmet = [goal for goal in self._goals if not self._world.satisfies(state, goal)]
        options = unmet or self._goals
        return options[int(random.integers(len(options)))]
