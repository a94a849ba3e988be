"""From each initial state of the office, both ways of reasoning start the same activity."""

import pytest

from agents.intentional import IntentionalRobot
from agents.intentional.reasoners import IncrementalReasoner, ReferenceReasoner
from tests.agents.intentional.lives import WORLD, live

STATES = list(WORLD.initial_states())
PARTS = 8


@pytest.mark.parametrize("part", range(PARTS))
def test_the_first_activity_is_the_theorys(part: int) -> None:
    for state in STATES[part::PARTS]:
        kept, plain = (
            live(IntentionalRobot(reasoner), state, steps=2).decisions[0].trace
            for reasoner in (IncrementalReasoner, ReferenceReasoner)
        )
        assert (kept.intention, kept.plan) == (plain.intention, plain.plan), WORLD.true_atoms(state)
