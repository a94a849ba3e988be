"""The pytest plugin, in suites as users write them: real peers, processes and runs."""

import os
import subprocess
import sys
from pathlib import Path

import pytest

from tests.greenhouse import GREENHOUSE
from tests.pots import POTS

SUITE = """
import pytest

from testbed.config import load_config
from testbed.environment import ROBOT
from testbed.experiment.plan import plan_trials
from testbed.experiment.trial import play_trial
from testbed.link import open_robot

ONE = ["scenarios=[1]", "limit=1", "robots=[intentional]"]


def test_the_peer_lets_robots_connect(zenoh_peer):
    assert zenoh_peer.endpoint.startswith("tcp/127.0.0.1:")
    with open_robot(zenoh_peer.endpoint) as other:
        assert not other.is_closed()


def test_a_robot_plays_in_its_own_process(robot_process):
    (spec,) = plan_trials(load_config("office", ONE))
    assert play_trial(spec, robot_process).record.outcome == "achieved"
    assert robot_process.process.pid


def test_a_world(world):
    assert world.description.name == "office"


@pytest.mark.testbed(config="pots.yaml", robots=["traditional"])
def test_what_is_marked(world, office_env, run_config):
    assert world.description.name == "pots"
    office_env.reset(seed=1)
    assert office_env.agent_selection == ROBOT
    run = run_config("limit=1")
    assert set(run.trials["robot"]) == {"traditional"}
    assert run_config("limit=2").folder != run.folder
"""
HEAVY = {"clingo", "gymnasium", "matplotlib", "msgspec", "numpy", "pettingzoo", "polars", "zenoh"}


@pytest.fixture
def suite(tmp_path: Path) -> Path:
    (tmp_path / "test_mine.py").write_text(SUITE, encoding="utf-8")
    (tmp_path / "pots.yaml").write_text(POTS, encoding="utf-8")
    (tmp_path / "pots.al").write_text(GREENHOUSE, encoding="utf-8")
    return tmp_path


def _pytest(
    folder: Path, *arguments: str, autoload: bool = True
) -> subprocess.CompletedProcess[str]:
    command = [sys.executable, "-m", "pytest", "-p", "no:cacheprovider", "-q", *arguments]
    alone = {} if autoload else {"PYTEST_DISABLE_PLUGIN_AUTOLOAD": "1"}
    environment = {**os.environ, **alone}
    return subprocess.run(
        command, cwd=folder, env=environment, capture_output=True, text=True, check=False
    )


@pytest.mark.parametrize("processes", [[], ["-n", "2"]])
def test_its_fixtures_work_and_the_process_ends(suite: Path, processes: list[str]) -> None:
    done = _pytest(suite, *processes, "--strict-markers")
    assert done.returncode == 0, done.stdout
    assert "4 passed" in done.stdout


@pytest.mark.parametrize(
    ("marker", "said"),
    [("colour='red'", "testbed("), ("config='offise'", "office"), ("robots=['nobody']", "nobody")],
)
def test_a_wrong_marker_is_told(suite: Path, marker: str, said: str) -> None:
    text = f"import pytest\n@pytest.mark.testbed({marker})\ndef test(run_config):\n  run_config()\n"
    (suite / "test_mine.py").write_text(text, encoding="utf-8")
    done = _pytest(suite, "--tb=line")
    assert done.returncode == 1
    assert said in done.stdout


def test_loading_it_imports_nothing_heavy(suite: Path) -> None:
    """Without the plugins of other distributions, which import what they like."""
    text = f"import sys\ndef test():\n  assert not set(sys.modules) & {HEAVY!r}\n"
    (suite / "test_mine.py").write_text(text, encoding="utf-8")
    done = _pytest(suite, "-p", "testbed.testing.plugin", autoload=False)
    assert done.returncode == 0, done.stdout
