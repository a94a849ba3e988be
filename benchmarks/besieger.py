"""The besieger: an adversary that undoes whatever a robot achieves, in any domain."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from agents.adversary import AdversaryView, Game
from asp.language import Action
from testbed.protocol import NONE
from testbed.world import world_of

EVERY = 4


class Besieger:
    """Does something at random at every so many steps, and whenever the goal would be achieved.

    What it does is such that the goal does not hold afterwards, and that it can be undone again.
    """

    @dataclass(frozen=True)
    class Options:
        """`every`: steps from one event to the next."""

        every: int = EVERY

    sees = ("state", "robot_action")

    def __init__(self, game: Game, options: Options) -> None:
        self._world, self._goal, self._every = world_of(game.description), game.goal, options.every
        self._own = game.description.agent_actions
        self.reset(0)

    def reset(self, seed: int) -> None:
        self._random = np.random.default_rng(seed)

    def act(self, view: AdversaryView) -> Action:
        state = self._world.state(view.state)
        own = self._effective(state, view.robot_action)
        if view.step % self._every and not self._achieves(state, own):
            return NONE
        events = [event for event in view.legal if event != NONE]
        drawn = [events[int(place)] for place in self._random.permutation(len(events))]
        undoing = [event for event in drawn if not self._achieves(state, (*own, event))]
        lasting = (event for event in undoing if self._lasts(state, (*own, event)))
        return next(lasting, next(iter(undoing), NONE))

    def _effective(self, state: int, action: Action | None) -> tuple[Action, ...]:
        possible = action in self._own and self._world.executable(state, [action])
        return (action,) if action is not None and possible else ()

    def _achieves(self, state: int, actions: Sequence[Action]) -> bool:
        return self._world.satisfies(self._world.successor(state, actions), self._goal)

    def _lasts(self, state: int, actions: Sequence[Action]) -> bool:
        """Whether what the robot may achieve next can be undone at once."""
        after, world = self._world.successor(state, actions), self._world
        return all(
            any(
                world.executable(after, [own, event]) and not self._achieves(after, (own, event))
                for event in world.exogenous_actions
            )
            for own in self._own
            if world.executable(after, [own]) and self._achieves(after, (own,))
        )
