"""Adversaries that look one step ahead and take an event that is worth most to them."""

from abc import ABC, abstractmethod
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Any, ClassVar

import numpy as np

from agents.adversary.base import AdversaryView, Game, Sight
from agents.adversary.lookahead import Lookahead
from asp.language import Action
from testbed.protocol import NONE


def check_rate(rate: float) -> None:
    """Raises ValueError for what is no probability."""
    if not 0 <= rate <= 1:
        raise ValueError(f"rate: {rate} does not lie between 0 and 1")


@dataclass(frozen=True)
class Rated:
    """`rate`: probability per step of an event, where one is worth anything.

    Raises ValueError for one that is none.
    """

    rate: float = 1.0

    def __post_init__(self) -> None:
        check_rate(self.rate)


class Choosing(ABC):
    """At each step, with probability `rate`, one of the legal events that are worth most.

    Which one is drawn. A strategy says what an event is worth, and what it remembers of a step.
    """

    Options: ClassVar[type] = Rated
    sees: Sequence[Sight] = ("state", "robot_action")

    def __init__(self, game: Game, options: Any) -> None:
        """Raises ValueError where the game does not tell what the strategy needs."""
        self._options, self._ahead = options, Lookahead(game)
        self.reset(0)

    def reset(self, seed: int) -> None:
        """Begins a trial."""
        self._random = np.random.default_rng(seed)

    def act(self, view: AdversaryView) -> Action:
        """An event that is worth most, or `none`."""
        state = self._ahead.state(view.state)
        self._watch(state, view)
        if self._random.random() >= self._options.rate:
            return NONE
        best = self._best(state, view)
        return best[int(self._random.integers(len(best)))] if best else NONE

    def _best(self, state: int, view: AdversaryView) -> list[Action]:
        rated = list(self._rated(state, view))
        most = max((worth for worth, _ in rated), default=())
        return [event for worth, event in rated if worth == most]

    def _rated(self, state: int, view: AdversaryView) -> Iterator[tuple[tuple[float, ...], Action]]:
        """The events that are worth anything; of several outcomes the worst for the adversary."""
        alone = self._ahead.after(state, view)
        for event in view.legal:
            outcomes = () if event == NONE else self._ahead.after(state, view, event)
            if outcomes:
                worth = min(self._worth(outcome, alone) for outcome in outcomes)
                if worth:
                    yield worth, event

    def _watch(self, state: int, view: AdversaryView) -> None:
        """Takes notice of a step before it is played; called at each step."""
        del state, view  # nothing is remembered

    @abstractmethod
    def _worth(self, outcome: int, alone: Sequence[int]) -> tuple[float, ...]:
        """What a next state is worth, where there would be those `alone` without an event.

        Empty: nothing.
        """
