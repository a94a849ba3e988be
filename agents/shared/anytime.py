"""Explanations where there is no time for a smallest one: any, bettered as far as the budget goes.

What was adopted is kept of all but the last steps, first of nearly all and then of ever less; so
the first explanation is found at once in most cases, and better ones follow.
"""

from __future__ import annotations

from collections.abc import Collection, Iterator, Mapping
from dataclasses import dataclass

import clingo

from agents.shared.history import Diagnosis
from agents.shared.limits import BETTERING, SEARCH
from asp.solving import BudgetError, Limits, current, deciding, preferring, solving, up_to

_FIRST_WINDOW = 4

Answer = tuple[clingo.Symbol, ...]


@dataclass(frozen=True)
class Search:
    """The explanations of a history up to a step in a control that has the theory of diagnosis."""

    control: clingo.Control
    adopted: Diagnosis
    step: int

    def best(self) -> Answer | None:
        """The shown atoms of the best explanation found, None if the control has none.

        While conflicts are left, ever more of the past is explained anew; if all of it is and no
        explanation was found, the search goes on until there is one, or time runs out: raises
        TimeLimitError.
        """
        best: Answer | None = None
        windows = list(_windows(self.step))
        for number, window in enumerate(windows, start=1):
            kept = self._kept(self.step - window)
            try:
                with up_to(SEARCH + (BETTERING - SEARCH) * number / len(windows)):
                    while (better := self._preferred([*kept, *self._below(best)])) is not None:
                        best = better
            except BudgetError:
                continue
            if best is None and window == self.step:
                return None
        return self._any() if best is None else best

    def _preferred(self, assumptions: list[int]) -> Answer | None:
        with preferring(self.control, assumptions) as model:
            return None if model is None else tuple(model.symbols(shown=True))

    def _any(self) -> Answer | None:
        """An explanation of any size, by a heuristic that is good at finding one."""
        self.control.configuration.solver.heuristic = "vsids"  # type: ignore[union-attr]
        with deciding(Limits(current().limits.seconds)), solving(self.control) as model:
            return None if model is None else tuple(model.symbols(shown=True))

    def _kept(self, until: int) -> list[int]:
        """Assumptions for the events and distrusted reports that were adopted, before a step."""
        adopted = self.adopted
        return [
            literal if event in those else -literal
            for predicate, events in (
                ("unobserved", adopted.unobserved),
                ("distrusted", adopted.distrusted),
            )
            for those in [frozenset((own.action, own.step) for own in events)]
            for event, literal in self._literals(predicate).items()
            if event[1] < until
        ]

    def _literals(self, predicate: str) -> Mapping[tuple[str, int], int]:
        atoms = self.control.symbolic_atoms.by_signature(predicate, 2)
        named = ((atom.symbol.arguments, atom.literal) for atom in atoms)
        return {(str(action), step.number): literal for (action, step), literal in named}

    def _below(self, best: Collection[clingo.Symbol] | None) -> list[int]:
        """Assumptions for fewer events and distrusted reports than the best one has."""
        if best is None:
            return []
        numbers = (symbol for symbol in best if symbol.match("number_unobserved", 2))
        size = next(numbers).arguments[0].number
        atoms = self.control.symbolic_atoms.by_signature("number_unobserved", 2)
        return [-atom.literal for atom in atoms if atom.symbol.arguments[0].number >= size]


def _windows(step: int) -> Iterator[int]:
    """Numbers of steps at the end of the history, the last one being all of them."""
    window = _FIRST_WINDOW
    while window < step:
        yield window
        window *= 2
    yield step
