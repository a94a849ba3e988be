"""Plans of one problem: a program of its own, with the actions that each step leaves to choose.

Where searches have narrowed down what a plan may consist of, this grounds a small part of what a
program for all problems would hold.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence

import clingo
from clingo import Symbol

from asp.language import Description
from asp.solving import (
    State,
    fact,
    goal_externals,
    ground,
    select,
    solving,
    symbol,
    theory,
)

MOST_LEVELS = 32_767
"""As many levels of decisions as clasp tells apart."""


class ProblemPrograms:
    """Programs of a description, each for one state and one goal."""

    def __init__(self, description: Description, program: str, facts: Iterable[Symbol]) -> None:
        """`program` is the description's translation; `facts` hold in all of its problems."""
        self._fluents = description.fluents
        self._program = program.replace(theory("awareness"), "")
        self._facts = tuple(facts)

    def first_plan(
        self,
        state: State,
        goal: tuple[str, ...],
        steps: Sequence[Sequence[str]],
        symmetric: Iterable[tuple[str, str]],
    ) -> tuple[str, ...] | None:
        """The first plan that takes one of the actions of each step, or None.

        The actions of a step are in the order of declaration. Where there are more of all steps
        than clasp has levels, the first ones are decided first, in a call of their own.
        """
        facts = [*goal_externals(goal)]
        facts += (fact("symmetric", *pair) for pair in symmetric)
        while True:
            plan = self._preferred(state, [*facts, *candidates(steps)], len(steps))
            if plan is None or _choices(steps) <= MOST_LEVELS:
                return plan
            steps = _after_deciding(steps, plan)

    def _preferred(
        self, state: State, facts: Iterable[Symbol], length: int
    ) -> tuple[str, ...] | None:
        given = [*self._given(state), *self._facts, *facts]
        texts = [self._program, theory("incremental_planning")]
        with solving(ground(texts, {"n": length}, given, ["plan"])) as model:
            if model is None:
                return None
            occurring = select(model.symbols(atoms=True), "occurs", 2)
        at = {step.number: str(action) for action, step in occurring}
        return tuple(at[step] for step in range(length))

    def _given(self, state: State) -> Iterator[Symbol]:
        zero = clingo.Number(0)
        for fluent in self._fluents:
            yield clingo.Function("holds", [symbol(fluent), zero], fluent in state)


def candidates(steps: Sequence[Sequence[str]]) -> Iterator[Symbol]:
    """candidate(A,I,L): the earlier in this order, the higher the level, while there are any.

    A step without a choice needs no level.
    """
    level = MOST_LEVELS
    for step, actions in enumerate(steps):
        for action in actions:
            yield fact("candidate", action, step, level if len(actions) > 1 else 0)
            level = max(level - 1, 0) if len(actions) > 1 else level


def _choices(steps: Sequence[Sequence[str]]) -> int:
    return sum(len(actions) for actions in steps if len(actions) > 1)


def _after_deciding(steps: Sequence[Sequence[str]], plan: Sequence[str]) -> list[Sequence[str]]:
    """What is left of the steps when as many actions as there are levels were decided."""
    left: list[Sequence[str]] = []
    levels = MOST_LEVELS
    for actions, taken in zip(steps, plan, strict=True):
        decided = actions[:levels] if len(actions) > 1 else actions
        left.append([taken] if taken in decided else actions[len(decided) :])
        levels -= len(decided) if len(actions) > 1 else 0
    return left
