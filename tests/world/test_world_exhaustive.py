"""The compiled world and the translated program have the same transition diagram.

The world is compiled from the ground description, the program is translated from the text and
grounded and solved by clingo: the two share no more than the parser.
"""

from itertools import product

import pytest

from asp import load_description
from asp.translation import translate
from testbed.world import world_of
from tests.world import diagram

OFFICE = load_description("office")
WORLD = world_of(OFFICE)


@pytest.fixture(scope="module")
def program() -> str:
    return translate(OFFICE.source, "office.al")


def test_the_430_states_are_those_of_the_program(program: str) -> None:
    assert {frozenset(WORLD.true_atoms(s)) for s in WORLD.states()} == diagram.states(program)


def test_all_43000_compound_actions_have_the_9755_transitions_of_the_program(program: str) -> None:
    robot = [(), *((action,) for action in WORLD.agent_actions)]
    adversary = [(), *((action,) for action in WORLD.exogenous_actions)]
    asked = list(product(WORLD.states(), robot, adversary))
    compiled = [
        (
            frozenset(WORLD.true_atoms(state)),
            frozenset(one + other),
            frozenset(WORLD.true_atoms(after)),
        )
        for state, one, other in asked
        for after in WORLD.successors(state, one + other)
    ]
    translated = diagram.transitions(program, diagram.ONE_OF_EACH)
    assert len(asked) == 430 * 10 * 10
    assert len(compiled) == len(translated) == 9755
    assert set(compiled) == set(translated)
