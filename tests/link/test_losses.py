"""What only a robot of another process can do: die, hang, or never be there."""

import os
import signal
import sys
from collections.abc import Callable, Iterator
from contextlib import ExitStack, closing, contextmanager

import pytest
import zenoh

from testbed.link import RemoteRobot, SpawnedRobot, endpoint, keys, open_driver, open_robot
from testbed.protocol import RobotGone, RobotLost
from tests.link.scripted import COMMAND, PATIENCE_S, percept, task

pytestmark = pytest.mark.load


def _lose(robot: SpawnedRobot, kind: str) -> RobotLost:
    robot.begin(task(kind))
    with pytest.raises(RobotLost) as lost:
        robot.ask(percept())
    return lost.value


def _works(robot: SpawnedRobot) -> bool:
    robot.begin(task("sound", "next"))
    return robot.ask(percept(1, "next")).trial == "next"


@contextmanager
def _once_in_trial(session: zenoh.Session, act: Callable[[], None]) -> Iterator[None]:
    """Do something as soon as the robot has got the question of a trial."""

    def notice(sample: zenoh.Sample) -> None:
        if sample.kind == zenoh.SampleKind.PUT:
            act()

    watched = keys.alive(keys.act("run", "t1"))
    with session.liveliness().declare_subscriber(watched, notice):
        yield


@pytest.mark.parametrize(
    ("kind", "reason"),
    [
        ("dying", "process ended with signal 9 (SIGKILL)"),
        ("exiting", "process ended with status 3: OSError: no space left"),
    ],
)
def test_a_robot_that_ends_in_mid_question_is_lost(
    spawned: SpawnedRobot, kind: str, reason: str
) -> None:
    assert _lose(spawned, kind).reason == reason
    assert _works(spawned)


def _signal(robot: SpawnedRobot, number: signal.Signals) -> None:
    assert robot.process is not None
    os.kill(robot.process.pid, number)


def test_a_robot_killed_while_it_thinks_is_lost_before_the_limit() -> None:
    with open_driver() as session, closing(_spawned(session, PATIENCE_S)) as robot:
        with _once_in_trial(session, lambda: _signal(robot, signal.SIGKILL)):
            lost = _lose(robot, "thinking")
        assert lost.reason == "process ended with signal 9 (SIGKILL)"
        assert _works(robot)


@pytest.mark.parametrize("stopped", [False, True])
def test_a_silent_robot_is_lost_at_the_limit(stopped: bool) -> None:
    with open_driver() as session, closing(_spawned(session, 1.0)) as robot:
        silence = signal.SIGSTOP if stopped else signal.SIGCONT
        with _once_in_trial(session, lambda: _signal(robot, silence)):
            assert _lose(robot, "thinking").reason == "no answer within 1 s"
        assert robot.process is None
        robot.begin(task("sound", "next"))
        assert robot.process is not None, "another one, which is there"


def test_a_robot_killed_between_trials_is_lost_and_replaced(spawned: SpawnedRobot) -> None:
    assert _works(spawned)
    _signal(spawned, signal.SIGKILL)
    with pytest.raises(RobotLost, match="SIGKILL"):
        spawned.ask(percept(2, "next"))
    assert _works(spawned)


def test_a_robot_that_cannot_start_says_why() -> None:
    command = (sys.executable, "-c", "raise SystemExit('no such robot')")
    with open_driver() as session, closing(SpawnedRobot(session, "run", 1.0, command)) as robot:
        with pytest.raises(RobotLost) as lost:
            robot.begin(task("sound"))
        assert lost.value.reason == "process ended with status 1: no such robot"


def test_a_robot_that_never_comes_is_lost(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("testbed.link.remote.PRESENCE_S", 0.1)
    with (
        open_driver() as session,
        closing(RemoteRobot(session, "run", "godot", 1.0)) as robot,
        pytest.raises(RobotGone, match="robot is not there"),
    ):
        robot.begin(task("sound"))


def test_zero_replies_are_a_lost_robot_and_not_an_answer() -> None:
    with (
        open_driver() as session,
        session.liveliness().declare_token(keys.robot("deaf")),
        closing(RemoteRobot(session, "run", "deaf", PATIENCE_S)) as robot,
    ):
        robot.begin(task("sound"))
        with pytest.raises(RobotGone, match="nobody answered"):
            robot.ask(percept())


def test_a_robot_that_leaves_holding_a_question_is_lost_before_the_limit() -> None:
    held: list[zenoh.Query] = []
    presence = ExitStack()

    def hold(query: zenoh.Query) -> None:
        held.append(query)
        presence.close()

    with (
        open_driver() as session,
        open_robot(endpoint(session)) as leaver,
        leaver.declare_queryable(keys.acts(), hold),
        closing(RemoteRobot(session, "run", "leaver", PATIENCE_S)) as robot,
    ):
        presence.enter_context(leaver.liveliness().declare_token(keys.robot("leaver")))
        robot.begin(task("sound"))
        with pytest.raises(RobotGone, match="robot is gone"):
            robot.ask(percept())
        with held.pop():
            """Let the question end."""


def _spawned(session: zenoh.Session, answer_s: float) -> SpawnedRobot:
    return SpawnedRobot(session, "run", answer_s, COMMAND)
