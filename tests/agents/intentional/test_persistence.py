"""An unfulfilled intention persists, whatever the robot learns of its past."""

import random

import pytest

from agents.intentional import IntentionalRobot
from agents.intentional.activities import Activity, History
from agents.intentional.reasoners import IncrementalReasoner, ReferenceReasoner
from agents.shared import Reasoner
from asp.language import Literal
from asp.reasoning import knowledge
from asp.reasoning.diagnosis import GOAL, SELECT, Explanation
from tests.agents.intentional.lives import DOMAIN, SOURCE, WORLD, Wish, live
from tests.literals import parsed
from tests.oracle import minimal_actions

STATES = list(WORLD.initial_states())
GOAL_OF_ONE = parsed(["loc(book2,office2)"])
PLAN = parsed(["move(rob1,office2)", "move(rob1,kitchen)", "pickup(rob1,book2)"])


def _history(stopped: bool) -> History:
    """The goal held at step 3: book2 was carried to office2, and at once to the library.

    The robot is told so late that it has an activity for the goal, or has had one.
    """
    history = History()
    start = parsed({"loc(book2,kitchen)", "loc(book1,kitchen)", "loc(rob1,office1)"})
    history.observe(parsed([f if f in start else f.complement for f in WORLD.fluents]), 0)
    history.happened(SELECT, True, 0)
    history.activities.append(Activity(1, PLAN))
    history.attempt(Literal.parse("start(1)"), 1)
    history.happened(Literal.parse("start(1)"), True, 1)
    history.happened(Literal.parse("exo_move(book2,office2)"), True, 2)
    history.happened(Literal.parse("exo_move(book2,library)"), True, 3)
    if stopped:
        history.attempt(Literal.parse("stop(1)"), 4)
        history.happened(Literal.parse("stop(1)"), True, 4)
    history.step = 5
    return history


@pytest.mark.parametrize("reasoner", [ReferenceReasoner, IncrementalReasoner])
@pytest.mark.parametrize("stopped", [False, True])
def test_a_goal_that_held_for_a_while_is_still_pursued(
    reasoner: type[Reasoner], stopped: bool
) -> None:
    history = _history(stopped)
    office = knowledge(DOMAIN, SOURCE)
    logician = reasoner(office, GOAL_OF_ONE, 20)  # type: ignore[call-arg]
    for step in range(1, 6):
        history.step = step
        explained = logician.diagnose(history, Explanation())
    intention = logician.intend(history, explained)
    assert GOAL not in intention.believed
    assert intention.action == ("start(2)" if stopped else "stop(1)")
    if stopped:
        now = WORLD.state(intention.believed)
        assert len(intention.plan) == minimal_actions(WORLD, now, GOAL_OF_ONE)


def test_four_events_never_keep_the_robot_from_its_goal() -> None:
    dice = random.Random(5)
    for number in range(400):
        steps = dice.sample(range(1, 25), 4)
        wishes = {step: Wish(dice.randrange(9), dice.random() < 0.3) for step in steps}
        life = live(IntentionalRobot(), STATES[number % 192], wishes=wishes, steps=150)
        assert life.achieved, (number, wishes)
