"""How far robots are from the optimum: what they needed, divided by the least that achieves it.

The least is what a search with complete knowledge finds from the initial state where nothing
exogenous happens (`judge`). Below 1 is who was helped on the way.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import asdict, dataclass
from statistics import fmean
from typing import NamedTuple

COMPARED = ("execution_units", "actions")
"""The measures of which the least is known."""


class Needed(NamedTuple):
    """The measures of a trial, the least of these, and what the trial weighs."""

    measures: Mapping[str, float]
    least: Mapping[str, int]
    weight: float = 1.0


@dataclass(frozen=True)
class Optimum:
    """Means over `trials` that achieved their goal; None where there is no such trial."""

    trials: int
    execution_units: float | None
    actions: float | None

    def values(self) -> dict[str, float | None]:
        """By the names of the fields."""
        return asdict(self)


def optimum(needed: Iterable[Needed]) -> Optimum:
    """That of trials that achieved their goal.

    A trial whose least is not known, or 0, is left out.
    """
    known = [own for own in needed if all(own.least.get(name) for name in COMPARED)]
    return Optimum(len(known), *(_mean(known, name) for name in COMPARED))


def _mean(known: Sequence[Needed], name: str) -> float | None:
    if not known:
        return None
    ratios = [own.measures[name] / own.least[name] for own in known]
    return fmean(ratios, weights=[own.weight for own in known])
