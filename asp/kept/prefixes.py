"""Explanations of the beginning of a history: what is kept of how a state came about."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace

from asp.kept.pasts import Assumed, Happening
from asp.kept.transitions import Branch

_INFINITE = float("inf")

Steps = tuple[int, "Steps"] | None
"""Steps as a chain, the last one first."""


@dataclass(frozen=True)
class Prefix:
    """An explanation up to a step: its events and distrusted reports, the latest first.

    `distrusts` and `assumes` are its place in the order of explanations that are as small, the
    first part being compared with others before the second; `held` are the steps at which the goal
    held.
    """

    events: tuple[Happening, ...] = ()
    distrusted: tuple[Happening, ...] = ()
    distrusts: tuple[tuple[float, ...], ...] = ()
    assumes: tuple[tuple[float, ...], ...] = ((_INFINITE,),)
    held: Steps = None

    @property
    def size(self) -> int:
        """How many events and false reports it assumes (27)."""
        return len(self.events) + len(self.distrusted)

    @property
    def order(self) -> tuple[object, ...]:
        """Its place: reports are believed, the latest first; then events are late (`order.lp`)."""
        return self.distrusts, self.assumes

    def is_of(self, assumed: Assumed) -> bool:
        """Whether it assumes these events and distrusts these reports."""
        return sorted(self.events) == sorted(assumed.events) and (
            sorted(self.distrusted) == sorted(assumed.distrusted)
        )

    def extended(
        self, branch: Branch, step: int, places: Mapping[str, int], reached: bool
    ) -> Prefix:
        """This and what a branch assumes of a step; `places` are those of exogenous actions.

        `reached` says whether the goal holds after the step.
        """
        held = (step + 1, self.held) if reached else self.held
        if not branch.size:
            return replace(self, held=held) if reached else self
        events, distrusted = (
            sorted(names, key=places.__getitem__) for names in (branch.events, branch.distrusted)
        )
        return Prefix(
            (*((step, event) for event in events), *self.events),
            (*((step, event) for event in distrusted), *self.distrusted),
            (*((step, -places[event]) for event in distrusted), *self.distrusts),
            (*((-step, places[event]) for event in events), *self.assumes),
            held,
        )

    def followed_by(self, end: Assumed, first: int) -> Assumed:
        """The whole explanation, with the end of the history explained from step `first` on."""
        return Assumed(
            _one_after_another(self.events, end.events, first),
            _one_after_another(self.distrusted, end.distrusted, first),
        )


def steps(chain: Steps) -> Iterator[int]:
    """The steps of a chain."""
    while chain is not None:
        step, chain = chain
        yield step


def _one_after_another(
    before: Sequence[Happening], after: Sequence[Happening], first: int
) -> tuple[Happening, ...]:
    return (*sorted(before), *((first + step, event) for step, event in after))
