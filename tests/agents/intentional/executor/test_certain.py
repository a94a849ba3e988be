"""What the robot knows of itself is certain: what it holds is where it is, whatever a test says."""

import pytest

from agents.intentional import IntentionalRobot
from agents.intentional.refined import RefinedRobot
from tests.agents.intentional.executor.faulty_world import Faults, Play, play
from tests.agents.intentional.executor.test_execution import GOAL, ROW, look
from tests.literals import parsed

HELD = parsed(
    [
        "fine_loc(rob1,room1_4)",
        "fine_loc(object1_1,room1_4)",
        "fine_in_hand(rob1,object1_2)",
        "fine_loc(object2_1,room3_4)",
    ]
)
PUT_DOWN = "fine_put_down(rob1,object1_2)"
MOVE = "fine_move(rob1,room2_1)"


def carried(faults: Faults, zooms: bool = True) -> Play:
    return play(RefinedRobot(IntentionalRobot(), zooms), ROW(), HELD, GOAL, faults)


@pytest.mark.parametrize("zooms", [True, False])
def test_a_thing_that_is_held_is_not_tested_for(zooms: bool) -> None:
    wrong = [(look("room2_1"), number) for number in range(1, 9)]
    went = carried(Faults(slips=[(PUT_DOWN, 1), (PUT_DOWN, 2)], lies=wrong), zooms)
    assert went.achieved
    assert went.actions == [MOVE, PUT_DOWN, PUT_DOWN, PUT_DOWN]
    assert not [d.action for d in went.decisions if d.action.startswith("test_fine_loc(rob1,obj")]


def test_news_of_a_thing_that_is_held_is_not_believed() -> None:
    """The event that is told is impossible, so that nothing comes of it."""
    away = {(MOVE, 1): "fine_exo_move(object1_1,room3_2)"}
    went = carried(Faults(events=away, reported=True, false=True))
    assert went.achieved
    assert went.actions == [MOVE, PUT_DOWN]


def test_an_execution_that_keeps_failing_is_no_event() -> None:
    often = [(MOVE, number) for number in range(1, 31)]
    went = carried(Faults(slips=often))
    assert went.achieved
    assert went.abstract == [
        ("move(rob1,room2)", False),
        ("move(rob1,room2)", False),
        ("move(rob1,room2)", True),
        ("put_down(rob1,object1)", True),
    ]
    explained = [d.trace.explanation for d in went.decisions if d.trace.explanation is not None]
    assert [each.unobserved for each in explained] == [[], []]
    assert [len(each.distrusted) for each in explained] == [1, 2]
    assert {told.action for each in explained for told in each.distrusted} == {"move(rob1,room2)"}


def test_one_event_is_preferred_to_two_attempts_that_were_not_executed() -> None:
    """The object is gone for good, and its room is searched again and again."""
    gone = {("fine_move(rob1,room1_2)", 1): "fine_exo_move(object1_1,room3_1)"}
    start = parsed(
        ["fine_loc(rob1,room1_1)", "fine_loc(object1_1,room1_3)", "fine_loc(object2_1,room3_4)"]
    )
    went = play(RefinedRobot(IntentionalRobot()), ROW(), start, GOAL, Faults(events=gone))
    assert went.achieved
    explained = [d.trace.explanation for d in went.decisions if d.trace.explanation is not None]
    assert explained
    assert not any(each.distrusted for each in explained)
