"""Sizes of ground programs: rules are counted while clingo grounds, which ends at a limit."""

from __future__ import annotations

from collections.abc import Hashable, Mapping, Sequence

import clingo
from clingo import Symbol

from asp.solving.budget import BudgetError, current

_RULES_BETWEEN_LOOKS = 1_000
_MARGIN = 4
_MOST_REMEMBERED = 1_000

Statement = Symbol | str
"""A fact, as a term or as its text."""


class _Counter(clingo.Observer):
    """Counts the rules of one control, however often it is ground further."""

    def __init__(self) -> None:
        self.rules = 0

    def rule(self, choice: bool, head: Sequence[int], body: Sequence[int]) -> None:
        """One rule more. What is raised here ends the grounding."""
        del choice, head, body
        self.rules += 1
        budget = current()
        most = budget.limits.ground_rules
        if most is not None and self.rules > most:
            raise BudgetError(f"a ground program has more than {most} rules")
        if self.rules % _RULES_BETWEEN_LOOKS == 0:
            budget.check_time()


# Counting takes as long as grounding, so that programs that are known to be small are not counted:
# those of the same texts and about as many steps, where these are far below the limit.
_counted: dict[Hashable, _Counter] = {}


def count_rules(
    control: clingo.Control, texts: Sequence[str], constants: Mapping[str, int]
) -> None:
    """What is ground in the control from now on raises LimitError, and stops, at a limit."""
    limits = current().limits
    if limits.ground_rules is None and limits.seconds is None:
        return
    key = (*texts, *((name, number.bit_length()) for name, number in constants.items()))
    known = _counted.get(key)
    if known is not None and known.rules * _MARGIN <= (limits.ground_rules or 0):
        return
    if len(_counted) >= _MOST_REMEMBERED:
        _counted.clear()
    _counted[key] = counter = _Counter()
    control.register_observer(counter)
