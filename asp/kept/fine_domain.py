"""A narrowed description: its lower bounds, and what controls are made of."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from functools import cached_property

from asp.kept.confining import Values, confined
from asp.kept.fitted import Problem, fitted_plan
from asp.kept.horizon import Horizon
from asp.kept.narrowing import Narrow, Narrower
from asp.kept.parts import confined as worded
from asp.kept.patterns import Function
from asp.kept.relaxed import Reach, Relaxed
from asp.kept.valued import Valued, valued


class FineDomain:
    """What plans in a narrowed description are made with.

    `size` is the number of its constants, `relaxed` has its lower bounds.
    """

    def __init__(
        self, narrower: Narrower, narrow: Narrow, functions: Mapping[str, Function]
    ) -> None:
        self.size = len(narrow.names)
        self._narrower = narrower
        self._narrow = narrow
        self._functions = functions
        self._program = narrower.program(narrow)
        self._actions = narrower.actions(narrow)
        self.relaxed = Relaxed(self._program)

    def horizon(self, length: int) -> Horizon:
        """A control for all problems of so many steps."""
        return Horizon(self._program, self._actions, length)

    def fitted(self, problem: Problem, reach: Reach, length: int) -> tuple[str, ...] | None:
        """The first plan of exactly so many steps, or None; nothing is kept for other problems."""
        steps = confined(reach, self._valued.number, length)
        left = [dict(self._told(values)) for values in steps]
        return fitted_plan(self._confinable, self._ranks, problem, left)

    def _told(self, values: Values) -> Iterator[tuple[str, Sequence[str]]]:
        """The functions confined at a step, with the fluents left."""
        for number, nodes in values.items():
            fluents = [self._valued.text[node] for node in nodes]
            yield from ((term, fluents) for term in self._valued.terms[number])

    @cached_property
    def _confinable(self) -> str:
        return self._narrower.program(self._narrow, worded)

    @cached_property
    def _ranks(self) -> Mapping[str, int]:
        return {action: rank for rank, action in enumerate(self._actions)}

    @cached_property
    def _valued(self) -> Valued:
        return valued(self.relaxed, self._functions)
