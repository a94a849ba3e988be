"""Shortest plans."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from functools import lru_cache

import clingo
from clingo import Symbol

from asp.kept.control import KeptControl, State, goal_externals

_REMEMBERED = 20_000
_SHORTEST = clingo.Function("shortest")


class Plans:
    """Shortest plans of a domain, and what becomes of given ones; one control a length."""

    def __init__(
        self,
        program: str,
        fluents: Sequence[str],
        actions: Sequence[str],
        ranks: Iterable[Symbol],
    ) -> None:
        self._program = program
        self._fluents = fluents
        self._actions = actions
        self._ranks = tuple(ranks)
        self._kept: dict[int, KeptControl] = {}
        self.shortest = lru_cache(maxsize=_REMEMBERED)(self._shortest)
        self.succeeds = lru_cache(maxsize=_REMEMBERED)(self._succeeds)

    def _shortest(self, state: State, goal: tuple[str, ...], limit: int) -> tuple[str, ...] | None:
        """The first of the shortest plans of at most `limit` actions, or None."""
        for length in range(1, limit + 1):
            kept = self._control(length)
            kept.switch_on(_SHORTEST, *goal_externals(goal))
            start = kept.assume_state(state, 0)
            if start is None:
                return None
            with kept.control.solve(assumptions=start, yield_=True) as handle:
                model = handle.model()
                if model is not None:
                    return self._read(kept, model, length)
        return None

    def _succeeds(self, state: State, goal: tuple[str, ...], plan: tuple[str, ...]) -> bool:
        """Whether the goal holds after some of the plan's actions, all possible until then (36)."""
        return any(self._reaches(state, goal, plan[:length]) for length in range(1, len(plan) + 1))

    def _reaches(self, state: State, goal: tuple[str, ...], plan: tuple[str, ...]) -> bool:
        kept = self._control(len(plan))
        kept.switch_on(*goal_externals(goal))
        start = kept.assume_state(state, 0)
        steps = [kept.literal("occurs", action, step) for step, action in enumerate(plan)]
        if start is None:
            return False
        assumptions = [*start, *(step for step in steps if step is not None)]
        return None not in steps and kept.control.solve(assumptions=assumptions).satisfiable is True

    def _control(self, length: int) -> KeptControl:
        if length not in self._kept:
            self._kept[length] = KeptControl(
                self._program, "kept_planning", self._fluents, self._ranks, n=length
            )
        return self._kept[length]

    def _read(self, kept: KeptControl, model: clingo.Model, length: int) -> tuple[str, ...]:
        return tuple(
            next(
                action
                for action in self._actions
                if (literal := kept.literal("occurs", action, step)) is not None
                and model.is_true(literal)
            )
            for step in range(length)
        )
