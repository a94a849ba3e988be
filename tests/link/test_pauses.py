"""A pause of a process costs nothing, whatever zenoh thinks of it: processes really stopped."""

import os
import signal
import subprocess
import sys
import threading
import time
from contextlib import ExitStack, closing
from pathlib import Path

import pytest
import zenoh

from testbed.link import SpawnedRobot, endpoint, open_driver
from tests.link.scripted import COMMAND, PATIENCE_S, percept, task

pytestmark = pytest.mark.load

WITNESS = """
import json, sys, time, zenoh
config = zenoh.Config()
settings = {
    "mode": "peer",
    "connect/endpoints": [sys.argv[1]],
    "listen/endpoints": [],
    "scouting/multicast/enabled": False,
    "transport/shared_memory/enabled": False,
}
for key, value in settings.items():
    config.insert_json5(key, json.dumps(value))
with zenoh.open(config) as session:
    token = session.liveliness().declare_token("witness")
    time.sleep(600)
"""
SHORTER_S = 8.0
"""An answer limit that is over before the witness is gone."""
DRIVER = f"""
from testbed.link import spawned_robot
from tests.link.scripted import COMMAND, percept, task

with spawned_robot("run", {SHORTER_S}, COMMAND) as robot:
    robot.begin(task("held"))
    print(robot.ask(percept()).step, flush=True)
"""


def test_a_pause_longer_than_zenohs_own_lease_costs_nothing(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Of a robot, and of a driver that waits for an answer, whose limit does not run meanwhile.

    A witness with that lease is stopped beside them, and tells when it is over.
    """
    monkeypatch.chdir(tmp_path)
    here, gone = threading.Event(), threading.Event()

    def notice(sample: zenoh.Sample) -> None:
        (here if sample.kind == zenoh.SampleKind.PUT else gone).set()

    with ExitStack() as stack:
        session = stack.enter_context(open_driver())
        robot = stack.enter_context(closing(SpawnedRobot(session, "run", PATIENCE_S, COMMAND)))
        robot.begin(task("sound"))
        before = robot.ask(percept(1)).action
        assert robot.process is not None
        stack.enter_context(session.liveliness().declare_subscriber("witness", notice))
        witness = _process(stack, WITNESS, endpoint(session))
        assert here.wait(PATIENCE_S)
        driver = _process(stack, DRIVER)
        while not Path("asked").exists():
            assert driver.poll() is None
            time.sleep(0.01)
        paused = (driver.pid, robot.process.pid, witness.pid)
        for process in paused:
            os.kill(process, signal.SIGSTOP)
        assert gone.wait(PATIENCE_S)
        Path("go").touch()
        for process in paused:
            os.kill(process, signal.SIGCONT)
        assert robot.ask(percept(2)).action == before, "the same process"
        assert driver.communicate()[0] == "1\n"


def _process(stack: ExitStack, *program: str) -> subprocess.Popen[str]:
    command = [sys.executable, "-c", *program]
    process = subprocess.Popen(command, stdout=subprocess.PIPE, text=True)
    stack.callback(process.wait)
    stack.callback(process.kill)
    return process
