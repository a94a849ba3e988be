"""What a command loads before it refuses what it was given: nothing that only playing needs."""

import json
import os
import subprocess
import sys
from pathlib import Path

import pytest

HEAVY = {
    "gymnasium",
    "jinja2",
    "matplotlib",
    "pettingzoo",
    "polars",
    "rich.console",
    "scipy.stats",
    "zenoh",
}
LOADED = """
import atexit, json, sys
atexit.register(lambda: print(json.dumps(sorted(sys.modules))))
from testbed.cli import main
sys.argv = ["testbed", *sys.argv[1:]]
main()
"""


@pytest.mark.parametrize(
    "mistyped",
    [
        "rnu quickstart",
        "run quikstart",
        "run quickstart scenarios=[77]",
        "check quikstart",
        "report no_such_folder",
        "export no_such_folder",
        "replay no_such_folder",
        "watch no_such_folder --once",
        "translate no_such_domain",
    ],
)
def test_what_is_mistyped_is_refused_before_anything_heavy_is_imported(mistyped: str) -> None:
    assert _loaded(mistyped).isdisjoint(HEAVY)


def test_a_process_of_a_robot_loads_nothing_of_the_world_and_of_experiments(tmp_path: Path) -> None:
    """The module of the robot, which is imported before it is served, tells what is there then."""
    spy = "import json, sys\nprint(json.dumps(list(sys.modules)))\nraise SystemExit\n"
    (tmp_path / "spying_robot.py").write_text(spy, encoding="utf-8")
    loaded = _loaded("robot --name spying_robot:Spy", tmp_path)
    assert "zenoh" in loaded
    assert loaded.isdisjoint({*HEAVY, "omegaconf"} - {"zenoh"})


def _loaded(refused: str, folder: Path | None = None) -> set[str]:
    """The modules that are imported when a command has been refused, by the first that tells."""
    root = str(Path(__file__).parents[2])
    path = os.pathsep.join([root, os.environ.get("PYTHONPATH", "")])
    command = [sys.executable, "-c", LOADED, *refused.split()]
    done = subprocess.run(
        command,
        check=False,
        capture_output=True,
        text=True,
        cwd=folder,
        env={**os.environ, "PYTHONPATH": path},
    )
    assert done.returncode == 2, done.stderr
    assert "Traceback" not in done.stderr
    return set(json.loads(done.stdout.splitlines()[0]))
