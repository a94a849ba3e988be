"""One step of the world ahead: the states that follow beside the robot's action."""

from collections.abc import Iterable
from functools import reduce
from operator import and_, or_

from agents.adversary.base import AdversaryView, Game
from asp.language import Action, Fluent
from testbed.protocol import NONE


class Lookahead:
    """The next states of a game, by event. States are those of the world: one bit per fluent.

    An attempt of the robot's that is possible is taken to succeed.
    """

    def __init__(self, game: Game) -> None:
        """Raises ValueError where the adversary is not told of the world."""
        if game.world is None:
            raise ValueError("this adversary looks ahead, and is told of no world")
        self.world = game.world
        self._robot = game.description.robots[0]
        self._bits = {fluent: 1 << number for number, fluent in enumerate(self.world.fluents)}

    def state(self, true: frozenset[Fluent]) -> int:
        """The state in which these fluents are true; others than the world's are left out."""
        return sum(self._bits.get(fluent, 0) for fluent in true)

    def after(self, state: int, view: AdversaryView, event: Action = NONE) -> tuple[int, ...]:
        """Where the robot's action and an event may lead together; nowhere: they cannot be."""
        world, action = self.world, view.robot_action
        own = (action,) if view.physical and action and world.executable(state, (action,)) else ()
        return world.successors(state, own if event == NONE else (*own, event))

    def seen(self, state: int) -> int:
        """The fluents of which the robot sees whether they hold, as bits."""
        return sum(self._bits[each.atom] for each in self.world.visible(state, self._robot))


def bits_in_any(masks: Iterable[int]) -> int:
    """The bits that are set in one of the masks at least."""
    return reduce(or_, masks, 0)


def bits_in_all(masks: Iterable[int]) -> int:
    """The bits that are set in each of the masks, of which there is one at least."""
    return reduce(and_, masks)
