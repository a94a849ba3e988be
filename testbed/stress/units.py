"""Units of a search: what is played and judged at once, by itself, wherever it is played.

A unit is all that its result depends on, so that units can be played by any process, and again.
"""

from collections.abc import Callable

import msgspec
import numpy as np

from agents.adversary import Events
from asp.language import Action
from testbed.config import StressSettings
from testbed.experiment.episodes import Episode, Player
from testbed.experiment.seeds import generator_of, short_hash
from testbed.experiment.specs import TrialSpec
from testbed.stress.objectives import judged
from testbed.stress.verdicts import Finding


class Judged(msgspec.Struct, frozen=True):
    """The verdict on one episode. `length` is the number of its steps."""

    events: tuple[tuple[int, Action], ...]
    length: int
    score: float
    chance: float | None
    findings: tuple[Finding, ...]


class Result(msgspec.Struct, frozen=True):
    """The verdicts of a unit; `left_out` is the number of next events that were not tried."""

    judged: tuple[Judged, ...]
    left_out: int = 0


class Branching(msgspec.Struct, frozen=True):
    """The episode with these events, and with every single one behind them."""

    case: TrialSpec
    events: Events

    @property
    def id(self) -> str:
        """What the journal calls it."""
        return short_hash([self.case.trial, self.events])

    def play(self, settings: StressSettings) -> Result:
        """Play and judge all of it; of more than `settings.branches` next events a sample."""
        player = Player(self.case)
        added = list(player.additions(self.events))
        kept = _sampled(len(added), settings.branches, self.id)
        branches = player.branches(self.events, [added[number] for number in kept])
        first = _judged(player.episode(self.events), settings)
        rest = [_judged(episode, settings) for episode in branches]
        return Result((first, *rest), len(added) - len(kept))


class Drawing(msgspec.Struct, frozen=True):
    """An episode with at most so many events, each drawn among all that may be added."""

    case: TrialSpec
    events: int
    number: int

    @property
    def id(self) -> str:
        """What the journal calls it."""
        return f"draw-{self.number}"

    def play(self, settings: StressSettings) -> Result:
        """Play and judge it."""
        player, draw = Player(self.case), generator_of(self.number, self.case.trial)
        events: Events = ()
        while len(events) < self.events and (added := list(player.additions(events))):
            events = (*events, added[int(draw.integers(len(added)))])
        return Result((_judged(player.episode(events), settings),))


Unit = Branching | Drawing
Play = Callable[[Unit, StressSettings], Result]


def play(unit: Unit, settings: StressSettings) -> Result:
    """Play a unit: what a process of an executor is given to do."""
    return unit.play(settings)


def _judged(episode: Episode, settings: StressSettings) -> Judged:
    verdict = judged(episode, settings)
    return Judged(
        events=episode.events,
        length=len(episode.moments),
        score=verdict.score,
        chance=episode.chance,
        findings=verdict.findings,
    )


def _sampled(count: int, most: int, unit: str) -> list[int]:
    """At most so many of the numbers below `count`, drawn evenly, in their order."""
    if count <= most:
        return list(range(count))
    draw = np.random.default_rng(int(unit, 16))
    return sorted(int(own) for own in draw.choice(count, most, replace=False))
