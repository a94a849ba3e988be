"""The exact probabilities of an adversary's answers, from every way in which its draws can end."""

from collections.abc import Iterable
from fractions import Fraction
from typing import Any

import numpy as np
import pytest

from agents.adversary import AdversaryView, Game, Triggered
from asp.language import Literal
from testbed.protocol import NONE
from testbed.world import World


class Scripted:
    """In place of a random generator: draws end as the `path` says, later ones with the first.

    `sizes` are among how many each draw was. Every coin is heads: the event is tried.
    """

    def __init__(self, path: list[int]) -> None:
        self.path, self.sizes = path, list[int]()

    def random(self) -> float:
        return 0.0

    def integers(self, size: int) -> int:
        self.sizes.append(size)
        place = len(self.sizes) - 1
        return self.path[place] if place < len(self.path) else 0


def chances(
    world: World, scenario: str, state: Iterable[str], action: str, patch: pytest.MonkeyPatch
) -> dict[str, Fraction]:
    """The probability of each answer in a state, beside a robot's action, once it tries."""
    description = world.description
    game = Game(
        scenario=scenario,
        goal=(),
        exogenous_actions=description.exogenous_actions,
        description=description,
    )
    number = world.state(list(state))
    own = [action] if world.executable(number, [action]) else []
    possible = [e for e in description.exogenous_actions if world.executable(number, [*own, e])]
    true = frozenset(world.true_atoms(number))
    view = AdversaryView(1, true, Literal.parse(action), [NONE, *possible])
    adversary, found, paths = Triggered(game, Triggered.Options()), dict[str, Fraction](), [[]]
    while paths:
        generator = Scripted(paths.pop())
        answer = _answer(adversary, view, generator, patch)
        chance = Fraction(1, int(np.prod(generator.sizes, dtype=int)))
        found[answer] = found.get(answer, Fraction(0)) + chance
        taken = [*generator.path, *[0] * len(generator.sizes)][: len(generator.sizes)]
        for place in range(len(generator.path), len(taken)):
            paths += [[*taken[:place], n] for n in range(1, generator.sizes[place])]
    return found


def _answer(
    adversary: Triggered, view: AdversaryView, generator: Any, patch: pytest.MonkeyPatch
) -> str:
    with patch.context() as own:
        own.setattr(np.random, "default_rng", lambda _: generator)
        adversary.reset(0)
    return str(adversary.act(view))
