"""An adversary that now and then does something at random."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np

from agents.adversary.base import AdversaryView, Game, Sight
from asp.language import Action, Literal
from testbed.protocol import NONE

RANDOM_RATE = 0.1
"""Probability per step of a random event at the coarse resolution, unless given."""


class Random:
    """At each step, with probability `rate`, one exogenous action among the legal ones.

    First what it is done to is drawn (the first argument), among those to which something can be
    done, then what is done. Only as many events are tried as it takes to find a legal one.
    """

    @dataclass(frozen=True)
    class Options:
        """`rate`: probability per step. Raises ValueError for one that is none."""

        rate: float = RANDOM_RATE

        def __post_init__(self) -> None:
            if not 0 <= self.rate <= 1:
                raise ValueError(f"rate: {self.rate} does not lie between 0 and 1")

    sees: Sequence[Sight] = ()

    def __init__(self, game: Game, options: Options) -> None:
        self._rate = options.rate
        groups: dict[tuple[str, ...], list[Action]] = {}
        for event in game.exogenous_actions:
            groups.setdefault(event.arguments[:1], []).append(event)
        self._groups = list(groups.values())
        self.reset(0)

    def reset(self, seed: int) -> None:
        self._random = np.random.default_rng(seed)

    def act(self, view: AdversaryView) -> Action:
        if self._random.random() >= self._rate:
            return NONE
        return next((event for event in self._drawn() if event in view.legal), NONE)

    def _drawn(self) -> Iterator[Literal]:
        """The events in a random order, those of one thing after those of another."""
        for number in self._random.permutation(len(self._groups)):
            group = self._groups[int(number)]
            for place in self._random.permutation(len(group)):
                yield group[int(place)]
