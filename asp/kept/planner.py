"""Plans of one program: a control for each length, grounded once."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from itertools import pairwise

import clingo

from asp.description import Description
from asp.kept.control import KeptControl, State, goal_externals
from asp.literals import arguments
from asp.solving import fact, is_satisfiable, solving

_SHORTEST = clingo.Function("shortest")


class Planner:
    """Answers whether there is a plan of a length, and whether a given one succeeds."""

    def __init__(
        self, description: Description, program: str, classes: Sequence[Sequence[str]]
    ) -> None:
        """`classes` are the interchangeable constants, each class in order of declaration."""
        self.classes = tuple(tuple(members) for members in classes)
        self._description = description
        self._program = program
        actions = description.agent_actions
        self._facts = [fact("ranks", len(actions))]
        self._facts += (fact("rank", action, number) for number, action in enumerate(actions))
        self._facts += (
            fact("names", action, constant)
            for action in actions
            for members in classes
            for constant in members
            if constant in arguments(action)
        )
        self._facts += (
            fact("neighbours", *pair) for members in classes for pair in pairwise(members)
        )
        self._kept: dict[int, KeptControl] = {}

    def plan(
        self,
        state: State,
        goal: tuple[str, ...],
        length: int,
        symmetric: Iterable[tuple[str, str]] = (),
    ) -> tuple[str, ...] | None:
        """The first plan of exactly this length that never goes back, or None.

        Of each symmetric pair the first constant is used first: a plan that does otherwise comes
        later in the order than the one with the two exchanged.
        """
        kept = self._control(length)
        ordered = (fact("symmetric", *pair) for pair in symmetric)
        kept.switch_on(_SHORTEST, *goal_externals(goal), *ordered)
        start = kept.assume_state(state, 0)
        if start is None:
            return None
        with solving(kept.control, start) as model:
            return None if model is None else self._read(kept, model, length)

    def reaches(self, state: State, goal: tuple[str, ...], plan: tuple[str, ...]) -> bool:
        """Whether all actions of the plan are possible and the goal holds after the last."""
        kept = self._control(len(plan))
        kept.switch_on(*goal_externals(goal))
        start = kept.assume_state(state, 0)
        steps = [kept.literal("occurs", action, step) for step, action in enumerate(plan)]
        if start is None:
            return False
        assumptions = [*start, *(step for step in steps if step is not None)]
        return None not in steps and is_satisfiable(kept.control, assumptions)

    def _control(self, length: int) -> KeptControl:
        if length not in self._kept:
            self._kept[length] = KeptControl(
                self._program,
                "kept_planning",
                self._description.fluents,
                self._facts,
                n=length,
            )
        return self._kept[length]

    def _read(self, kept: KeptControl, model: clingo.Model, length: int) -> tuple[str, ...]:
        return tuple(
            next(
                action
                for action in self._description.agent_actions
                if (literal := kept.literal("occurs", action, step)) is not None
                and model.is_true(literal)
            )
            for step in range(length)
        )
