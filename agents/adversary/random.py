"""An adversary that now and then does something at random."""

from collections.abc import Collection, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from math import inf

import numpy as np

from agents.adversary.base import AdversaryView, Game, Sight
from agents.adversary.choosing import check_rate
from asp.language import Action, Literal
from testbed.protocol import NONE

RANDOM_RATE = 0.1
"""Probability per step of a random event at the coarse resolution, unless given."""


class Random:
    """At each step, with probability `rate`, one exogenous action among the legal ones.

    First what it is done to is drawn (the first argument), among those to which something can be
    done, then what is done; with a `mix` the kind of event is drawn before. Only as many events are
    tried as it takes to find a legal one.
    """

    @dataclass(frozen=True)
    class Options:
        """How often, in what clusters, from when on and of what kinds events happen.

        `rate`: probability per step; `burst`: mean number of steps with events on end, in bursts
        that are so rare that the probability per step remains; `delay`: no event before this step;
        `mix`: weights of exogenous actions by name, None: all events alike. Raises ValueError for
        numbers that are none of these.
        """

        rate: float = RANDOM_RATE
        burst: float = 1.0
        delay: int = 0
        mix: dict[str, float] | None = None

        def __post_init__(self) -> None:
            check_rate(self.rate)
            if not 1 <= self.burst < inf:
                raise ValueError(f"burst: {self.burst} is no mean length; 1 is the least")
            if self.delay < 0:
                raise ValueError(f"delay: {self.delay} is not a step")
            weights = [1.0] if self.mix is None else [*self.mix.values()]
            if not (all(0 <= weight < inf for weight in weights) and 0 < sum(weights) < inf):
                raise ValueError("mix: weights are numbers from 0 on, and not all of them 0")

        @property
        def named_events(self) -> Mapping[str, Collection[str]]:
            """The names of exogenous actions that options have, by option."""
            return {"mix": self.mix or ()}

        @property
        def start(self) -> float:
            """Probability that a burst begins at a step at which none goes on."""
            if self.burst == 1:
                return self.rate
            return self.rate / (self.rate + self.burst * (1 - self.rate))

    sees: Sequence[Sight] = ()

    def __init__(self, game: Game, options: Options) -> None:
        self._options = options
        self._groups = list(_grouped(game.exogenous_actions).values())
        kinds = {
            name: _grouped(event for event in game.exogenous_actions if event.name == name)
            for name, weight in (options.mix or {}).items()
            if weight
        }
        self._kinds = {name: list(own.values()) for name, own in kinds.items() if own}
        self.reset(0)

    def reset(self, seed: int) -> None:
        """Begins a trial, before it in a burst as often as at any later step."""
        self._random = np.random.default_rng(seed)
        options = self._options
        self._goes_on = options.burst > 1 and bool(self._random.random() < options.rate)

    def act(self, view: AdversaryView) -> Action:
        if view.step < self._options.delay or not self._happens():
            return NONE
        return next((event for event in self._drawn() if event in view.legal), NONE)

    def _happens(self) -> bool:
        """Whether there is to be an event now."""
        burst, draw = self._options.burst, self._random.random
        self._goes_on = self._goes_on and draw() < 1 - 1 / burst
        happens = self._goes_on or bool(draw() < self._options.start)
        self._goes_on = happens and burst > 1
        return happens

    def _drawn(self) -> Iterator[Literal]:
        """The events in a random order, those of one thing after those of another."""
        if self._options.mix is None:
            yield from self._in_order(self._groups)
            return
        for name in self._names(self._options.mix):
            yield from self._in_order(self._kinds[name])

    def _names(self, mix: Mapping[str, float]) -> Iterator[str]:
        """The kinds of events in a random order, each the next one by its weight."""
        left = list(self._kinds)
        while left:
            weights = np.array([mix[name] for name in left])
            yield left.pop(int(self._random.choice(len(left), p=weights / weights.sum())))

    def _in_order(self, groups: Sequence[Sequence[Action]]) -> Iterator[Literal]:
        for number in self._random.permutation(len(groups)):
            group = groups[int(number)]
            for place in self._random.permutation(len(group)):
                yield group[int(place)]


def _grouped(events: Iterable[Action]) -> dict[tuple[str, ...], list[Action]]:
    """Events by what they are done to, the first argument."""
    groups: dict[tuple[str, ...], list[Action]] = {}
    for event in events:
        groups.setdefault(event.arguments[:1], []).append(event)
    return groups
