"""An adversary that lengthens the robot's way to the goal, one step ahead."""

from collections.abc import Sequence
from dataclasses import dataclass

from agents.adversary.base import Game, Measure
from agents.adversary.choosing import Choosing, Rated


class Greedy(Choosing):
    """The event after which the least that achieves the goal is greatest.

    It has to be more than without an event, by `gain` at least. Where the search for one of them
    was given up, the event is not taken.
    """

    @dataclass(frozen=True)
    class Options(Rated):
        """`measure`: what is to be more, the robot's actions or its execution units."""

        measure: Measure = "actions"
        gain: float = 1.0

        def __post_init__(self) -> None:
            super().__post_init__()
            if not self.gain > 0:
                raise ValueError(f"gain: {self.gain} is not greater than 0")

    def __init__(self, game: Game, options: Options) -> None:
        super().__init__(game, options)
        if game.remaining is None:
            raise ValueError("this adversary has to be told how far states are from the goal")
        self._remaining, self._measure, self._gain = game.remaining, options.measure, options.gain

    def _worth(self, outcome: int, alone: Sequence[int]) -> tuple[float, ...]:
        far = [self._remaining(state, self._measure) for state in (outcome, *alone)]
        known = [each for each in far if each is not None]
        if len(known) < len(far):
            return ()
        after, *without = known
        # Infinitely far both ways is no gain: the difference is then not a number.
        return (after,) if after - max(without) >= self._gain else ()
