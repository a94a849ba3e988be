"""An adversary that a person plays."""

from collections.abc import Callable, Sequence

from agents.adversary.base import AdversaryView, Game, Sight
from agents.shared.presence import Presence
from asp.language import Action

PERSON: Presence[Callable[[AdversaryView], Action]] = Presence("adversary")
"""Who is asked for the answer at a step."""


class Human:
    """Answers what a person answers, who sees all that an adversary can see."""

    sees: Sequence[Sight] = ("state", "robot_action", "trace")

    def __init__(self, game: Game, options: object) -> None:
        """Raises ValueError where there is no person to ask."""
        del game, options  # a person is told of them by who asks
        if PERSON.ask is None:
            raise ValueError("nobody is there to ask; play it by: testbed play CONFIG")
        self._ask = PERSON.ask

    def reset(self, seed: int) -> None:
        """Nothing is drawn."""

    def act(self, view: AdversaryView) -> Action:
        """The person's answer."""
        return self._ask(view)
