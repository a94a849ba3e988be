"""An adversary that acts where the robot does not look, against what it believes."""

from collections.abc import Sequence

from agents.adversary.base import AdversaryView, Game, Sight
from agents.adversary.choosing import Choosing
from agents.adversary.lookahead import bits_in_all


class Belief(Choosing):
    """Makes as much as possible of what the robot believes false, so that it sees nothing of it.

    Events of which the robot sees fewest changes come first, then those that contradict most of
    its belief unseen. At a step at which the robot tells no belief it is taken to believe what
    its action makes of the last one that it told; without any, nothing happens.
    """

    sees: Sequence[Sight] = ("state", "robot_action", "trace")

    def __init__(self, game: Game, options: object) -> None:
        super().__init__(game, options)
        self._about = self._ahead.state(frozenset(game.description.fluents))

    def reset(self, seed: int) -> None:
        """The robot has not told anything yet."""
        super().reset(seed)
        self._expected: int | None = None

    def _watch(self, state: int, view: AdversaryView) -> None:
        """What the robot expects of the next step: its belief, and what its action does to it."""
        del state  # the belief need not be so
        told = view.trace.belief if view.trace is not None else ()
        believed = self._ahead.state(frozenset(told)) if told else self._expected
        if believed is not None:
            self._expected = next(iter(self._ahead.after(believed, view)), believed)

    def _worth(self, outcome: int, alone: Sequence[int]) -> tuple[float, ...]:
        if self._expected is None:
            return ()
        changed, seen = bits_in_all(outcome ^ each for each in alone), self._ahead.seen(outcome)
        wrong = changed & ~seen & self._about & (outcome ^ self._expected)
        return (-(changed & seen).bit_count(), wrong.bit_count()) if wrong else ()
