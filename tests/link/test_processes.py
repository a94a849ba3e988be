"""Processes meet only whom they should, and end when they should."""

import os
import signal
import subprocess
import sys
from collections.abc import Iterator
from contextlib import ExitStack, closing, contextmanager

import pytest
import zenoh

from testbed.link import (
    RemoteRobot,
    SpawnedRobot,
    endpoint,
    keys,
    open_driver,
    open_robot,
    spawned_robot,
)
from testbed.link.process import RobotProcess
from testbed.protocol import Decision, RobotLost, decode
from tests.link.scripted import COMMAND, PATIENCE_S, percept, task

pytestmark = pytest.mark.load

DRIVER = """
import sys
from testbed.link import spawned_robot
from tests.link.scripted import percept, task
from tests.link.scripted import COMMAND

with spawned_robot("run", 60, COMMAND) as robot:
    robot.begin(task("sound"))
    print(robot.ask(percept()).step, flush=True)
    {then}
"""
LEFT_OPEN = """
import sys
from testbed.link import SpawnedRobot, open_driver
from tests.link.scripted import COMMAND, percept, task

session = open_driver()
robot = SpawnedRobot(session, "run", 60, COMMAND)
robot.begin(task("sound"))
print(robot.ask(percept()).step, flush=True)
{then}
"""
HOST = """
import time
from testbed.link import RemoteRobot, endpoint, open_driver
from tests.link.scripted import percept, task

with open_driver() as session:
    print(endpoint(session), flush=True)
    robot = RemoteRobot(session, "run", "rob", 600)
    robot.begin(task("thinking"))
    print("met", flush=True)
    if {asks}:
        robot.ask(percept())
    time.sleep(600)
"""


def test_two_runs_side_by_side_never_meet() -> None:
    with (
        spawned_robot("run", PATIENCE_S, COMMAND) as one,
        spawned_robot("run", PATIENCE_S, COMMAND) as other,
    ):
        for robot in (one, other):
            robot.begin(task("sound"))
        for step in (1, 2):
            for robot in (one, other):
                assert robot.ask(percept(step)).action == f"served_by({_pid(robot)})"
        assert _pid(one) != _pid(other)


def test_a_driver_is_reached_on_loopback_only() -> None:
    with open_driver() as one, open_driver() as other:
        assert endpoint(one).startswith("tcp/127.0.0.1:")
        assert endpoint(one) != endpoint(other)
        assert one.info.peers_zid() == other.info.peers_zid() == []


def test_a_robot_finds_no_driver_at_a_dead_endpoint(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("testbed.link.session.CONNECT_S", 0.1)
    with open_driver() as session:
        dead = endpoint(session)
    with pytest.raises(zenoh.ZError):
        open_robot(dead)


def test_of_several_robots_only_the_one_named_is_asked() -> None:
    with open_driver() as session, ExitStack() as stack:
        served = {name: _serve(stack, session, name, PATIENCE_S) for name in ("ann", "ben", "cleo")}
        for name, (robot, _) in served.items():
            robot.begin(task("sound", name))
        for step in (1, 2, 3):
            for name, (robot, pid) in served.items():
                assert robot.ask(percept(step, name)).action == f"served_by({pid})"


def test_a_busy_robot_does_not_hold_up_another() -> None:
    with open_driver() as session, ExitStack() as stack:
        busy, _ = _serve(stack, session, "busy", 0.5)
        free, _ = _serve(stack, session, "free", PATIENCE_S)
        busy.begin(task("thinking", "long"))
        with pytest.raises(RobotLost, match="no answer within"):
            busy.ask(percept(1, "long"))
        free.begin(task("sound", "short"))
        assert free.ask(percept(1, "short")).trial == "short"


def test_every_decision_is_published() -> None:
    with open_driver() as session, closing(SpawnedRobot(session, "run", 60, COMMAND)) as robot:
        with session.declare_subscriber(f"{keys.ROOT}/*/*/*/trace") as published:
            robot.begin(task("sound"))
            given = robot.ask(percept())
            sample = published.recv()
        assert str(sample.key_expr) == keys.trace(keys.act("run", "t1"))
        assert decode(bytes(sample.payload), Decision) == given


@pytest.mark.parametrize(
    ("then", "status"), [("pass", 0), ("sys.exit(7)", 7), ("raise ValueError", 1)]
)
def test_a_driver_process_ends(then: str, status: int) -> None:
    driver = subprocess.run(
        [sys.executable, "-c", DRIVER.format(then=then)],
        stdout=subprocess.PIPE,
        stderr=subprocess.DEVNULL,
        timeout=PATIENCE_S,
    )
    assert (driver.returncode, driver.stdout) == (status, b"1\n")


@pytest.mark.parametrize(
    ("then", "status"), [("pass", 0), ("sys.exit(7)", 7), ("raise ValueError", 1)]
)
def test_a_session_left_open_does_not_keep_its_process(then: str, status: int) -> None:
    driver = subprocess.run(
        [sys.executable, "-c", LEFT_OPEN.format(then=then)],
        stdout=subprocess.PIPE,
        stderr=subprocess.DEVNULL,
        timeout=PATIENCE_S,
    )
    assert (driver.returncode, driver.stdout) == (status, b"1\n")


@pytest.mark.parametrize("thinking", [False, True])
def test_a_robot_ends_with_its_driver(thinking: bool) -> None:
    with _python("-c", HOST.format(asks=thinking)) as host:
        where = _line(host)
        with _python(*COMMAND[1:], "--connect", where, "--name", "rob") as robot:
            assert _line(host) == "met"
            if thinking:
                assert _line(robot) == "thinking"
            host.kill()
            assert robot.wait(PATIENCE_S) == 0


def test_an_interrupted_robot_ends_quietly() -> None:
    with open_driver() as session:
        robot = RobotProcess(endpoint(session), "rob", COMMAND)
        with closing(robot), closing(RemoteRobot(session, "run", "rob", 1.0)) as remote:
            assert remote.wait(PATIENCE_S)
            os.kill(robot.pid, signal.SIGINT)
            assert robot.ending(PATIENCE_S) == "process ended with status 0"


def _serve(
    stack: ExitStack, session: zenoh.Session, name: str, answer_s: float
) -> tuple[RemoteRobot, int]:
    process = stack.enter_context(closing(RobotProcess(endpoint(session), name, COMMAND)))
    robot = stack.enter_context(closing(RemoteRobot(session, "run", name, answer_s)))
    assert robot.wait(PATIENCE_S)
    return robot, process.pid


@contextmanager
def _python(*arguments: str) -> Iterator[subprocess.Popen[str]]:
    with subprocess.Popen(
        [sys.executable, *arguments], stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True
    ) as process:
        try:
            yield process
        finally:
            process.kill()


def _line(process: subprocess.Popen[str]) -> str:
    assert process.stdout is not None
    return process.stdout.readline().strip()


def _pid(robot: SpawnedRobot) -> int:
    assert robot.process is not None
    return robot.process.pid
