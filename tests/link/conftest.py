"""What the link's tests share."""

import os
from collections.abc import Iterator
from contextlib import AbstractContextManager, closing
from pathlib import Path

import pytest

from testbed.link import InProcessRobot, SpawnedRobot, spawned_robot
from testbed.protocol import RobotClient
from tests.link.scripted import COMMAND, PATIENCE_S, ScriptedRobot


@pytest.fixture(autouse=True)
def _importable(monkeypatch: pytest.MonkeyPatch) -> None:
    """Let robot processes import the scripted robot wherever the tests were started."""
    root = str(Path(__file__).parents[2])
    monkeypatch.setenv("PYTHONPATH", os.pathsep.join([root, os.environ.get("PYTHONPATH", "")]))


@pytest.fixture
def spawned() -> Iterator[SpawnedRobot]:
    """A scripted robot in its own process."""
    with spawned_robot("run", PATIENCE_S, COMMAND) as robot:
        yield robot


def _client(link: str) -> AbstractContextManager[RobotClient]:
    if link == "inprocess":
        return closing(InProcessRobot(ScriptedRobot))
    return spawned_robot("run", PATIENCE_S, COMMAND)


@pytest.fixture(params=["inprocess", "zenoh"])
def client(request: pytest.FixtureRequest) -> Iterator[RobotClient]:
    """A scripted robot behind either link."""
    with _client(request.param) as robot:
        yield robot
