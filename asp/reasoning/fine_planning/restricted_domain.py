"""A narrowed description: its lower bounds, and what controls are made of."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Collection, Iterator, Mapping, Sequence
from functools import cached_property

from asp.language import Function, arguments
from asp.reasoning.fine_planning.abstraction import Narrow, Narrower
from asp.reasoning.fine_planning.horizon import Horizon
from asp.reasoning.fine_planning.large.function_values import Valued, valued
from asp.reasoning.fine_planning.large.problem_program import Problem, fitted_plan
from asp.reasoning.fine_planning.large.relaxed_reachability import Reach, Relaxed
from asp.reasoning.fine_planning.large.value_pruning import Values, confined
from asp.reasoning.fine_planning.relevant_constants import in_play, loose
from asp.translation import BASE
from asp.translation import confined as worded


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
        playing = self._loose | in_play(reach, self._valued, steps)
        facts = [f"{fact}." for fact in self._facts_about(playing)]
        program = "\n".join([self._confinable, f"#program {BASE}.", *facts])
        return fitted_plan(program, self._ranks, problem, left)

    def _facts_about(self, constants: Collection[str]) -> Iterator[str]:
        """What is so at all times of these constants only."""
        for constant in (*sorted(constants), ""):  # in one order in all processes
            for fact in self._facts.get(constant, ()):
                if all(other in constants for other in arguments(fact)):
                    yield fact

    def _told(self, values: Values) -> Iterator[tuple[str, Sequence[str]]]:
        """The functions confined at a step, with the fluents left."""
        for number, nodes in values.items():
            fluents = [self._valued.text[node] for node in nodes]
            yield from ((term, fluents) for term in self._valued.terms[number])

    @cached_property
    def _confinable(self) -> str:
        return self._narrower.worded(self._narrow, worded)

    @cached_property
    def _loose(self) -> frozenset[str]:
        return loose(self._narrower.kept(self._narrow), dict(self._narrow.sorts))

    @cached_property
    def _facts(self) -> Mapping[str, Sequence[str]]:
        """By their first constant."""
        found: dict[str, list[str]] = defaultdict(list)
        for fact in self.relaxed.facts:
            found[next(iter(arguments(fact)), "")].append(fact)
        return found

    @cached_property
    def _ranks(self) -> Mapping[str, int]:
        return {action: rank for rank, action in enumerate(self._actions)}

    @cached_property
    def _valued(self) -> Valued:
        return valued(self.relaxed, self._functions)
