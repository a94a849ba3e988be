"""Plans of all problems of a description: a control for each length, grounded once."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

import clingo
from clingo import Symbol

from asp.language import Description
from asp.reasoning.planning.large.problem_program import candidates
from asp.solving import Recent, Session, State, fact, goal_externals, is_satisfiable, solving

MOST_LENGTHS = 40
"""Of how many lengths of plans controls are kept: those that were used last.

Where no search gives the length they are asked one after the other, from 1 to that of the plan:
were fewer kept than a plan has actions, each decision would ground all of them again.
"""

_LEAST_HORIZON = 8


class SharedPrograms:
    """The controls of a description; state and goal are assumptions and externals.

    What `NarrowPrograms` grounds for one problem each, these hold for all of them.
    """

    def __init__(self, description: Description, program: str, facts: Iterable[Symbol]) -> None:
        """`program` is the description's translation; `facts` hold in all of its problems."""
        self._fluents = description.fluents
        self._actions = description.agent_actions
        self._program = program
        self._facts = tuple(facts)
        self._planning: Recent[int, Session] = Recent(MOST_LENGTHS)
        self._following: Recent[int, Session] = Recent(MOST_LENGTHS)

    def first_plan(
        self,
        state: State,
        goal: tuple[str, ...],
        length: int,
        symmetric: Iterable[tuple[str, str]],
    ) -> tuple[str, ...] | None:
        """The first plan of this length in the order of declaration, or None."""
        kept = self._planning.get(length, lambda: self._made("plan", length))
        ordered = (fact("symmetric", *pair) for pair in symmetric)
        kept.switch_on(*goal_externals(goal), *ordered)
        start = kept.assume_state(state, 0)
        if start is None:
            return None
        with solving(kept.control, start) as model:
            return None if model is None else self._read(kept, model, length)

    def succeeds(self, state: State, goal: tuple[str, ...], plan: Sequence[str]) -> bool:
        """Whether the goal holds after some of the plan's actions, all possible until then."""
        horizon = horizon_of(plan)
        kept = self._following.get(horizon, lambda: self._made("follow", horizon))
        follows = (fact("follows", action, step) for step, action in enumerate(plan))
        kept.switch_on(*goal_externals(goal), *follows)
        start = kept.assume_state(state, 0)
        return start is not None and is_satisfiable(kept.control, start)

    def _made(self, part: str, steps: int) -> Session:
        facts = (*self._facts, *candidates([self._actions] * steps))
        return Session(self._program, "incremental_planning", self._fluents, facts, [part], n=steps)

    def _read(self, kept: Session, model: clingo.Model, length: int) -> tuple[str, ...]:
        return tuple(
            next(
                action
                for action in self._actions
                if (literal := kept.literal("occurs", action, step)) is not None
                and model.is_true(literal)
            )
            for step in range(length)
        )


def horizon_of(plan: Sequence[str]) -> int:
    """How many steps the control has that follows a plan: few horizons serve all lengths."""
    return 1 << (max(len(plan), _LEAST_HORIZON) - 1).bit_length()
