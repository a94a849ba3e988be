"""An adversary of one's own: it spoils what has been achieved.

testbed run examples/custom_adversary.yaml
"""

from dataclasses import dataclass

import numpy as np

from agents.adversary import AdversaryView, Game


class Spoiler:
    """Once a part of the goal holds, does something to what it is about, while the robot acts."""

    @dataclass(frozen=True)
    class Options:
        """`times`: how often per trial; `patience`: no event before this step."""

        times: int = 1
        patience: int = 1

    sees = ("state", "robot_action")

    def __init__(self, game: Game, options: Options) -> None:
        self._goal, self._options = game.goal, options

    def reset(self, seed: int) -> None:
        """Begins a trial: all chance comes from its seed."""
        self._random = np.random.default_rng(seed)
        self._left = self._options.times

    def act(self, view: AdversaryView) -> str:
        """An event that is legal beside the robot's action, or `none`."""
        if not (self._left and view.physical and view.step >= self._options.patience):
            return "none"
        spoilt = {goal.arguments[0] for goal in self._goal if self._holds(goal, view)}
        events = [event for event in view.legal if spoilt.intersection(event.arguments[:1])]
        if not events:
            return "none"
        self._left -= 1
        return events[int(self._random.integers(len(events)))]

    def _holds(self, literal: str, view: AdversaryView) -> bool:
        return literal.is_positive and literal.atom in view.state
