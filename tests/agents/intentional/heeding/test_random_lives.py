"""Random games under every `relevance`: belief beside what is in view, both ways of reasoning."""

import random
from collections.abc import Iterator
from functools import cache
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import get_args

import pytest

from agents.intentional import IntentionalRobot
from testbed.protocol import Relevance
from tests.agents.intentional.heeding.domains import BLOCKS, CANAL, SMITHY, port
from tests.agents.intentional.lives import OFFICE, Life, Place, Wish, live, place
from tests.agents.intentional.test_incremental import BOTH

TEXTS = {"blocks": BLOCKS, "canal": CANAL, "smithy": SMITHY, "port": port("B", "S")}
DOMAINS = ["office", *TEXTS]
GAMES = 25


@cache
def _place(name: str) -> Place:
    if name not in TEXTS:
        return OFFICE
    with TemporaryDirectory() as folder:
        file = Path(folder) / f"{name}.al"
        file.write_text(TEXTS[name], encoding="utf-8")
        return place(str(file))


def _lives(domain: str, relevance: Relevance, games: int, *reasoner: type) -> Iterator[Life]:
    """Games with three events each, for goals of one or two fluents, some out of reach."""
    where, dice = _place(domain), random.Random(domain)
    world = where.world
    states = list(world.initial_states())
    for _ in range(games):
        goal = dice.sample(world.fluents, dice.choice((1, 1, 2)))
        steps = dice.sample(range(1, 12), 3)
        wishes = {step: Wish(dice.randrange(9), dice.random() < 0.2) for step in steps}
        yield live(
            IntentionalRobot(*reasoner),
            dice.choice(states),
            goal,
            wishes,
            steps=15,
            where=where,
            relevance=relevance,
        )


@pytest.mark.parametrize("relevance", get_args(Relevance))
@pytest.mark.parametrize("domain", DOMAINS)
def test_what_is_heeded_is_believed_and_the_rest_is_on_record(
    domain: str, relevance: Relevance
) -> None:
    where, walked_past = _place(domain), 0
    for life in _lives(domain, relevance, GAMES):
        for decision, state in zip(life.decisions, life.states, strict=False):
            belief = frozenset(decision.trace.belief)
            visible = where.world.visible(state, where.robot)
            against = {each for each in visible if (each.atom in belief) != each.is_positive}
            assert against == set(decision.trace.unheeded or ())
            walked_past += len(against)
    if relevance == "all":
        assert walked_past == 0


@pytest.mark.parametrize("relevance", get_args(Relevance))
@pytest.mark.parametrize("domain", DOMAINS)
def test_both_ways_of_reasoning_agree(domain: str, relevance: Relevance) -> None:
    for _ in _lives(domain, relevance, 2, BOTH):
        pass
