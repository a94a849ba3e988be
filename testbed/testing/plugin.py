"""The pytest plugin of the testbed: fixtures with a local zenoh peer, robots, worlds and runs.

It is there wherever the testbed is installed, and imports nothing of it until a fixture is used.
`@pytest.mark.testbed(config=..., robots=[...])` says what the fixtures of a test are made of.
"""

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

import pytest

if TYPE_CHECKING:
    import zenoh

    from testbed.analysis import Run
    from testbed.environment.aec import OrderedView
    from testbed.link import SpawnedRobot
    from testbed.world import World

CONFIG, ROBOTS = "office", ("intentional",)
"""What fixtures are made of without a marker."""
ANSWER_S = 60.0
MARKER = (
    "testbed(config='office', robots=['intentional']): the configuration (a file beside the test, "
    "or the name of a packaged one) and the robots that the testbed's fixtures are made of"
)


@dataclass(frozen=True)
class Peer:
    """A zenoh session that listens on a free port of this machine: robots connect to `endpoint`."""

    session: "zenoh.Session"
    endpoint: str


@dataclass(frozen=True)
class Marked:
    """What the marker of a test says."""

    config: str | Path = CONFIG
    robots: Sequence[str] = ROBOTS


def pytest_configure(config: pytest.Config) -> None:
    """Registers the marker."""
    config.addinivalue_line("markers", MARKER)


@pytest.fixture
def zenoh_peer() -> Iterator[Peer]:
    """A local peer on a free loopback port, which is closed at the end of the test."""
    from testbed.link import endpoint, open_driver

    with open_driver() as session:
        yield Peer(session, endpoint(session))


@pytest.fixture
def robot_process(zenoh_peer: Peer) -> Iterator["SpawnedRobot"]:
    """A robot in a process of its own, connected to the peer; it plays any robot of a task.

    The process begins with the first trial, and ends with the test.
    """
    from contextlib import closing

    from testbed.link import SpawnedRobot

    with closing(SpawnedRobot(zenoh_peer.session, "pytest", ANSWER_S)) as robot:
        yield robot


@pytest.fixture
def world(request: pytest.FixtureRequest) -> "World":
    """The world of the marked configuration's domain, at the coarse resolution."""
    from testbed.config import load_config
    from testbed.world import load_world

    marked = _marked(request)
    return load_world(load_config(marked.config).domain)


@pytest.fixture
def office_env(request: pytest.FixtureRequest) -> Iterator["OrderedView"]:
    """The AEC environment of the marked configuration, without a game: call `reset`."""
    from testbed import office_v0

    env = office_v0.env(_marked(request).config)
    yield env
    env.close()


RunConfig = Callable[..., "Run"]


@pytest.fixture
def run_config(request: pytest.FixtureRequest, tmp_path: Path) -> RunConfig:
    """Plays a small run into `tmp_path`: `run_config("limit=2", "scenarios=[1]")`.

    It is of the marked configuration and robots, played in this process with the robots where
    `link` says; overrides are those of the command line. What it returns is `testbed.load_run` of
    the folder. Raises ConfigError; a trial that fails is in the run.
    """
    from testbed import load_run
    from testbed.cli.loading import load
    from testbed.experiment.run_folder import write_config
    from testbed.experiment.runner import play_missing

    marked = _marked(request)

    def play(*overrides: str) -> Any:
        robots = f"robots=[{', '.join(marked.robots)}]"
        config = load(marked.config, [robots, *overrides])
        folder = _unused(tmp_path)
        write_config(folder, config)
        play_missing(config, folder, 0, lambda _: None)
        return load_run(folder)

    return play


def _marked(request: pytest.FixtureRequest) -> Marked:
    """What the marker of the test says; files, and modules of robots, are beside the test."""
    from testbed.registry import search_last

    search_last(request.path.parent)
    marker = request.node.get_closest_marker("testbed")
    if marker is None:
        return Marked()
    try:
        marked = Marked(*marker.args, **marker.kwargs)
    except TypeError:
        raise pytest.UsageError(f"{request.node.nodeid}: use @pytest.mark.{MARKER}") from None
    beside = request.path.parent / marked.config
    return Marked(beside if beside.is_file() else marked.config, marked.robots)


def _unused(folder: Path) -> Path:
    number = sum(own.name.startswith("run") for own in folder.iterdir())
    return folder / f"run{number}"
