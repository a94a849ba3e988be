"""An adversary that plays a policy which was learned, from a file of plain arrays."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import ClassVar

import numpy as np

from agents.adversary.base import AdversaryView, Game, Sight
from agents.adversary.policy import Policy, load_policy
from asp.language import Action
from testbed.protocol import FINISH, NONE, WAIT
from testbed.world import World

PACKAGED = Path(__file__).parent / "policies"
DOES, LEFT = "does ", "left "
"""Before the names of inputs: the robot's action, what is left to the adversary."""


class Learned:
    """At each step the legal action that the policy prefers; of equals the first.

    It sees what the adversary's side of the environment observes. Actions that the policy does not
    know are not taken.
    """

    @dataclass(frozen=True)
    class Options:
        """`policy`: the file, or the name of a packaged one; `sample`: draw, by the softmax of the
        preferences, instead of taking the greatest.

        Raises PolicyError, a ValueError, for a file that is none.
        """

        files: ClassVar[tuple[str, ...]] = ("policy",)
        policy: str
        sample: bool = False

        def __post_init__(self) -> None:
            _ = self.network

        @cached_property
        def network(self) -> Policy:
            """The policy of the file, or the packaged one of this name."""
            packaged = PACKAGED / f"{self.policy}.npz"
            is_packaged = Path(self.policy).name == self.policy and packaged.is_file()
            return load_policy(packaged if is_packaged else Path(self.policy))

        def misfits(self, world: World) -> Iterator[tuple[str, str]]:
            """What the policy has that is not of a world, by option."""
            known = {*map(str, world.exogenous_actions), NONE}
            unknown = [own for own in self.network.actions if own not in known]
            inputs = _input_names(world)
            unknown += [own for own in self.network.inputs if own not in inputs]
            if unknown:
                yield "policy", f"{self.policy}: was learned in another domain, with {unknown[0]}"

    sees: Sequence[Sight] = ("state", "robot_action")

    def __init__(self, game: Game, options: Options) -> None:
        """Raises ValueError for a policy of another domain."""
        self._policy, self._sample = options.network, options.sample
        assert game.world is not None
        for _, why in options.misfits(game.world):
            raise ValueError(why)
        self._fluents = frozenset(map(str, game.world.fluents))
        self.reset(0)

    def reset(self, seed: int) -> None:
        """Begins a trial."""
        self._random = np.random.default_rng(seed)

    def act(self, view: AdversaryView) -> Action:
        """The preferred legal action."""
        values = {**dict.fromkeys(self._fluents, -1.0), **dict(_inputs(view))}
        seen = np.array([values.get(name, 0.0) for name in self._policy.inputs], np.float32)
        legal = frozenset(view.legal)
        known = [n for n, own in enumerate(self._policy.actions) if own in legal]
        if not known:
            return NONE
        preferences = self._policy.preferences(seen)[known]
        chosen = int(np.argmax(preferences))
        if self._sample:
            shares = np.exp(preferences - preferences.max(), dtype=np.float64)
            chosen = int(self._random.choice(len(known), p=shares / shares.sum()))
        return Action.parse(self._policy.actions[known[chosen]])


def _input_names(world: World) -> frozenset[str]:
    """The names that inputs may have in games of a world, whatever their rules."""
    answers = (WAIT, FINISH, *world.agent_actions)
    sorts = world.description.sorts.items()
    objects = (f"{sort} {own}" for sort, constants in sorts for own in constants)
    left = (f"{LEFT}{own}" for own in ("budget", "cooldown", *objects))
    return frozenset((*map(str, world.fluents), *(f"{DOES}{own}" for own in answers), *left))


def _inputs(view: AdversaryView) -> Iterator[tuple[str, float]]:
    """The inputs that are neither 0 nor of a false fluent, by name."""
    yield from ((str(fluent), 1.0) for fluent in view.state)
    yield f"{DOES}{view.robot_action}", 1.0
    left = view.left
    if left.budget is not None:
        yield f"{LEFT}budget", float(left.budget)
    yield f"{LEFT}cooldown", float(left.cooldown)
    for sort, own in left.per_object.items():
        yield from ((f"{LEFT}{sort} {name}", float(number)) for name, number in own.items())
