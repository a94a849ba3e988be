"""An adversary that plays a policy which was learned, from a file of plain arrays."""

from collections.abc import Collection, Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import ClassVar

import numpy as np

from agents.adversary.base import AdversaryView, Game, Sight
from agents.adversary.policy import Policy, load_policy
from asp.language import Action
from testbed.protocol import NONE

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

        @property
        def named_events(self) -> Mapping[str, Collection[str]]:
            """The names of exogenous actions that the policy knows, by option."""
            names = (own.partition("(")[0] for own in self.network.actions if own != NONE)
            return {"policy": [*dict.fromkeys(names)]}

    sees: Sequence[Sight] = ("state", "robot_action")

    def __init__(self, game: Game, options: Options) -> None:
        """Raises ValueError for a policy that has an input which is not of this game."""
        self._policy, self._sample = options.network, options.sample
        assert game.world is not None
        self._fluents = frozenset(map(str, game.world.fluents))
        for name in self._policy.inputs:
            if not (name in self._fluents or name.startswith((DOES, LEFT))):
                raise ValueError(f"{options.policy}: was learned in another domain, with {name}")
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
