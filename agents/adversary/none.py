"""An adversary that leaves the robot alone."""

from collections.abc import Sequence

from agents.adversary.base import AdversaryView, Game, Sight
from asp.language import Action
from testbed.protocol import NONE


class Nothing:
    """Never does anything: what a robot takes by itself."""

    sees: Sequence[Sight] = ()

    def __init__(self, game: Game, options: object) -> None:
        """Neither the game nor any option makes a difference."""

    def reset(self, seed: int) -> None:
        """Nothing is drawn."""

    def act(self, view: AdversaryView) -> Action:
        """None at all."""
        del view
        return NONE
