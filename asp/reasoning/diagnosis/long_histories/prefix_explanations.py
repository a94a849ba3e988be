"""Explanations of the beginning of a history: what is kept of how a state came about."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace

from asp.reasoning.diagnosis.encoding import Assumed, Happening
from asp.reasoning.successors import Branch

_INFINITE = float("inf")
_ATTEMPT, _END, _REPORT = range(3)

Steps = tuple[int, "Steps"] | None
"""Steps as a chain, the last one first."""


@dataclass(frozen=True)
class Prefix:
    """An explanation up to a step: its events, its distrusted reports and attempts, latest first.

    `distrusts` and `assumes` are its place in the order of explanations that are as small, the
    first part being compared with others before the second; `held` are the steps at which the goal
    held. In `distrusts` an attempt comes before the end, and the end before a report.
    """

    events: tuple[Happening, ...] = ()
    distrusted: tuple[Happening, ...] = ()
    distrusts: tuple[tuple[float, ...], ...] = ((_END,),)
    assumes: tuple[tuple[float, ...], ...] = ((_INFINITE,),)
    held: Steps = None

    @property
    def size(self) -> int:
        """How many events, and false reports and attempts, it assumes (27)."""
        return len(self.events) + len(self.distrusted)

    @property
    def order(self) -> tuple[object, ...]:
        """Its place (`order.lp`): what is distrusted, the latest first; then events are late."""
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
        events = sorted(branch.events, key=places.__getitem__)
        # An attempt has no place among exogenous actions, and comes before reports.
        distrusted = sorted(branch.distrusted, key=lambda action: places.get(action, -1))
        return Prefix(
            (*((step, event) for event in events), *self.events),
            (*((step, event) for event in distrusted), *self.distrusted),
            (*(_distrust(step, places.get(action)) for action in distrusted), *self.distrusts),
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


def _distrust(step: int, place: int | None) -> tuple[int, ...]:
    return (_ATTEMPT, -step) if place is None else (_REPORT, step, -place)


def _one_after_another(
    before: Sequence[Happening], after: Sequence[Happening], first: int
) -> tuple[Happening, ...]:
    return (*sorted(before), *((first + step, event) for step, event in after))
