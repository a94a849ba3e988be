"""One suite over the in-process and the zenoh client: they answer, and fail, alike."""

import pytest

from testbed.protocol import RobotClient, RobotLost, RobotStopped
from tests.link.scripted import percept, task

pytestmark = [pytest.mark.load, pytest.mark.versions]

FAULTS = {
    "raising": "robot failed: ArithmeticError: out of ideas",
    "babbling": "answer not understood: not a Decision: ",
    "foreign": "answer not understood: not a Decision: Object missing required field `trial`",
    "newer": "answer not understood: protocol version 2, understood is 1",
    "late": "answer is for step 0 of trial t1, the question was for step 1 of trial t1",
    "elsewhere": "answer is for step 1 of trial another, the question was for step 1 of trial t1",
    "timeless": "answer not understood: not a Decision: ",
    "nested": "answer not understood: not a Decision: ",
    "verbose": "answer not understood: ",
    "unheard_of": "robot failed: KeyError: 'unheard_of'",
}


def test_a_trial_is_a_sequence_of_decisions(client: RobotClient) -> None:
    client.begin(task("sound"))
    decisions = [client.ask(percept(step)) for step in (1, 2, 3)]
    assert [(d.trial, d.step) for d in decisions] == [("t1", 1), ("t1", 2), ("t1", 3)]
    assert {d.action for d in decisions} == {decisions[0].action}
    assert all(d.trace.belief == ["-lit(lamp)"] for d in decisions)


def test_trials_follow_each_other(client: RobotClient) -> None:
    for trial in ("t1", "a trial/with*awkward?marks", "t3"):
        client.begin(task("sound", trial))
        assert client.ask(percept(1, trial)).trial == trial


@pytest.mark.parametrize("fault", FAULTS)
def test_a_fault_loses_the_robot_for_one_trial(client: RobotClient, fault: str) -> None:
    client.begin(task(fault))
    with pytest.raises(RobotLost) as lost:
        client.ask(percept())
    assert lost.value.reason.startswith(FAULTS[fault])
    assert "\n" not in lost.value.reason
    client.begin(task("sound", "t2"))
    assert client.ask(percept(1, "t2")).step == 1


def test_a_robot_that_stops_is_not_lost(client: RobotClient) -> None:
    client.begin(task("sound", "t0"))
    before = client.ask(percept(1, "t0")).action
    client.begin(task("stopping"))
    with pytest.raises(RobotStopped) as stopped:
        client.ask(percept())
    assert (stopped.value.reason, stopped.value.details) == ("nothing explains what was seen", "")
    client.begin(task("sound", "t2"))
    assert client.ask(percept(1, "t2")).action == before, "the same process"


def test_the_details_of_a_failure_are_the_robots_traceback(client: RobotClient) -> None:
    client.begin(task("raising"))
    with pytest.raises(RobotLost) as lost:
        client.ask(percept())
    assert lost.value.details.startswith("Traceback")
    assert "in _raise" in lost.value.details  # the place in the robot's own code
    assert lost.value.details.rstrip().endswith("ideas")


def test_a_trial_that_has_not_begun_is_not_answered(client: RobotClient) -> None:
    client.begin(task("sound", "t1"))
    client.ask(percept(1, "t1"))
    with pytest.raises(RobotLost, match="trial t2 has not begun here"):
        client.ask(percept(1, "t2"))
