"""Shortest plans at the fine resolution, zoomed or not, from controls that are grounded once."""

from __future__ import annotations

from collections import OrderedDict
from functools import lru_cache

from asp import syntax
from asp.fine_plans import FinePlan, FineStart, NoPlan, nowhere
from asp.kept.horizon import Horizon
from asp.kept.narrowing import Narrow, Narrower
from asp.kept.patterns import functions, subjects
from asp.signature import Signature

_MOST_NARROWED = 1_000


class FinePlanner:
    """Plans in one refined description, or in parts of it."""

    def __init__(self, source: syntax.Source, signature: Signature, most: int = 32) -> None:
        """`source` has the physics only; at most `most` controls are kept."""
        self._constants = signature.constants
        self._functions = functions(source, signature)
        self._places = subjects(self._functions, signature)
        self._narrower = Narrower(source, signature)
        self._narrow = lru_cache(_MOST_NARROWED)(self._narrower.narrow)
        self._most = most
        self._kept: OrderedDict[object, Horizon] = OrderedDict()

    def plan(
        self,
        start: FineStart,
        goal: tuple[str, ...],
        limit: int,
        constants: frozenset[str] | None = None,
    ) -> FinePlan | NoPlan:
        """The first of the shortest plans of at most `limit` actions.

        Of candidates those are assumed that make it short. `constants` are those of the part of
        the description that is planned in (None: the whole). Raises TimeLimitError, ValueError.
        """
        if not all(start.candidates):
            return NoPlan.OUT_OF_REACH
        kept = self._constants if constants is None else constants
        here = start.within(kept)
        narrow = self._narrow(kept.difference(*nowhere(here, self._functions, self._places)))
        horizon = self._horizon(narrow)
        assumed = horizon.start(
            frozenset(narrow.seen(here.true)),
            frozenset(fluent for group in here.candidates for fluent in narrow.seen(group)),
        )
        wanted = narrow.seen(goal)
        for length in range(limit + 1):
            plan = horizon.plan(assumed, wanted, length)
            if plan is not None:
                return narrow.back(plan)
        return NoPlan.BEYOND_LIMIT

    def _horizon(self, narrow: Narrow) -> Horizon:
        """The control of a narrowed description, used last of all kept ones."""
        if narrow.key not in self._kept:
            program, actions = self._narrower.program(narrow), self._narrower.actions(narrow)
            self._kept[narrow.key] = Horizon(program, (), actions)
        self._kept.move_to_end(narrow.key)
        while len(self._kept) > self._most:
            self._kept.popitem(last=False)
        return self._kept[narrow.key]
