"""The robot command: whom it serves with which options, and how it ends."""

import json
import os
import signal
import subprocess
import sys
from collections.abc import Iterator
from contextlib import ExitStack, closing, contextmanager
from pathlib import Path

import pytest
import zenoh

from testbed.cli.robot import USUAL
from testbed.link import RemoteRobot, endpoint, open_driver

pytestmark = pytest.mark.load

PATIENCE_S = 600.0
SERVE = "import sys; from testbed.cli import robot; {setting}; robot.command({call})"


@contextmanager
def _serving(call: str, setting: str = "pass") -> Iterator[subprocess.Popen[str]]:
    command = [sys.executable, "-c", SERVE.format(setting=setting, call=call)]
    root = str(Path(__file__).parents[2])
    environment = {**os.environ, "PYTHONPATH": root}
    with subprocess.Popen(command, stderr=subprocess.PIPE, text=True, env=environment) as process:
        try:
            yield process
        finally:
            process.kill()


def _present(session: zenoh.Session, name: str) -> bool:
    with closing(RemoteRobot(session, "run", name, PATIENCE_S)) as robot:
        return robot.wait(PATIENCE_S)


def _interrupted(process: subprocess.Popen[str]) -> tuple[int, str]:
    process.send_signal(signal.SIGINT)
    _, errors = process.communicate(timeout=PATIENCE_S)
    return process.returncode, errors


def test_without_options_it_serves_the_usual_endpoint_as_often_as_somebody_is_there(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    with open_driver() as session:
        usual = endpoint(session)
    with _serving("None, 'rob', None", f"robot.USUAL = '{usual}'") as process:
        monkeypatch.setattr("testbed.link.session.LOOPBACK", usual)
        for _ in range(2):
            with open_driver() as session:
                assert _present(session, "rob")
        assert _interrupted(process) == (0, f"robot 'rob' serves whoever listens at {usual}\n")


def test_the_usual_endpoint_is_that_of_a_router() -> None:
    assert USUAL == "tcp/127.0.0.1:7447"


@pytest.mark.parametrize("by_mode", [False, True])
def test_a_configuration_and_an_endpoint_are_served_both(tmp_path: Path, by_mode: bool) -> None:
    with ExitStack() as stack:
        one, other = (stack.enter_context(open_driver()) for _ in range(2))
        stated = {"peer": [endpoint(one)]} if by_mode else [endpoint(one)]
        settings = {
            "mode": "peer",
            "connect": {"endpoints": stated},
            "listen": {"endpoints": []},
            "scouting": {"multicast": {"enabled": False}, "gossip": {"enabled": False}},
        }
        file = tmp_path / "zenoh.json5"
        file.write_text(json.dumps(settings), encoding="utf-8")
        call = f"'{endpoint(other)}', 'rob', __import__('pathlib').Path({str(file)!r})"
        with _serving(call) as process:
            assert _present(one, "rob")
            assert _present(other, "rob")
            assert _interrupted(process) == (0, "")
