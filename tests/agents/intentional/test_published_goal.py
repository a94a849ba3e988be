"""All initial states of the office, against searches over the compiled world."""

import pytest

from agents.intentional import IntentionalRobot
from tests.agents.intentional.lives import BOTH_IN_THE_LIBRARY, WORLD, Wish, live
from tests.oracle import minimal_actions

STATES = list(WORLD.initial_states())


def test_there_are_192_initial_states() -> None:
    assert len(STATES) == 192


def test_all_192_are_solved_with_a_shortest_plan() -> None:
    robot = IntentionalRobot()
    for state in STATES:
        life = live(robot, state)
        physical = [d.action for d in life.decisions if d.action not in ("wait", "finish")]
        assert life.achieved, WORLD.true_atoms(state)
        assert len(physical) == minimal_actions(WORLD, state, BOTH_IN_THE_LIBRARY)
        assert life.decisions[-1].trace.plans == (1 if physical else 0)


@pytest.mark.parametrize("step", [1, 2, 4, 7])
def test_one_event_never_keeps_the_robot_from_its_goal(step: int) -> None:
    robot = IntentionalRobot()
    for number, state in enumerate(STATES):
        life = live(robot, state, wishes={step: Wish(number)}, steps=80)
        assert life.achieved, (WORLD.true_atoms(state), step, number)
