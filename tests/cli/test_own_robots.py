"""Robots of one's own: by `module:Class` and by entry points, checked before anything runs."""

import json
import os
import subprocess
import sys
from contextlib import closing
from pathlib import Path

import pytest
from typer.testing import CliRunner

from testbed.cli import app
from testbed.link import RemoteRobot, endpoint, open_driver
from testbed.protocol import Percept, RobotLost, Task
from testbed.registry import PATH_VARIABLE
from tests.greenhouse import GREENHOUSE
from tests.pots import CARRIED

ROOT = Path(__file__).parents[2]
PATIENCE_S = 600.0
CARRIER = "carriers_of_pots:Carrier"
CONFIG = """\
name: pots
domain: pots.al
goal: ["stands(fern,sill)"]
initial: ["stands(fern,bench)", "stands(rose,floor)"]
scenarios: none
"""
ROBOT = f"""\
from testbed.protocol import Capabilities

{CARRIED}

class Carrier:
    capabilities = Capabilities({{able}})

    def begin(self, task):
        pass

    def act(self, percept):
        return carried(percept)


class Idle:
    capabilities = Capabilities()


class Tall(Carrier):
    def __init__(self, height):
        pass


class Secretive:
    def begin(self, task): ...
    def act(self, percept): ...


carrier = Carrier()
"""


@pytest.fixture(autouse=True)
def _own(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """A configuration and modules beside it, looked at from somewhere else."""
    monkeypatch.setenv("PYTHONPATH", str(ROOT))
    monkeypatch.setenv(PATH_VARIABLE, "")
    monkeypatch.setattr(sys, "path", list(sys.path))
    beside = tmp_path / "beside"
    beside.mkdir()
    (beside / "pots.al").write_text(GREENHOUSE, encoding="utf-8")
    (beside / "pots.yaml").write_text(CONFIG, encoding="utf-8")
    monkeypatch.chdir(tmp_path)


def _module(name: str, text: str = ROBOT.format(able="")) -> None:
    Path(f"beside/{name}.py").write_text(text, encoding="utf-8")


def _run(*arguments: str, **environment: str) -> subprocess.CompletedProcess[str]:
    return subprocess.run(
        [sys.executable, "-P", "-m", "testbed", *arguments],
        check=False,
        capture_output=True,
        text=True,
        env={**os.environ, **environment},
    )


def _refused(*arguments: str) -> str:
    done = CliRunner().invoke(app, list(arguments))
    assert done.exit_code == 2, done.output
    (line,) = done.stderr.splitlines()
    return line


def _outcomes(folder: str) -> dict[str, str]:
    records = map(json.loads, Path(folder, "trials.jsonl").read_text("utf-8").splitlines())
    return {record["robot"]: record["outcome"] for record in records}


def test_a_robot_beside_the_configuration_plays_with_the_others() -> None:
    """In a process of its own and in its driver's; also where a run is gone on with, or replayed,
    from its folder, which does not hold the robot.
    """
    _module("carriers_of_pots")
    both = "robots=[carriers_of_pots:Carrier,traditional]"
    done = _run("run", "beside/pots.yaml", both, "--out", "run", "--quiet")
    assert done.returncode == 0, done.stderr
    expected = {"carriers_of_pots:Carrier": "achieved", "traditional": "achieved"}
    assert _outcomes("run") == expected
    Path("run/trials.jsonl").write_text("", encoding="utf-8")
    go_on = ["run", "run/config.yaml", "link=inprocess", "--out", "run", "--resume", "--quiet"]
    again = _run(*go_on)
    assert again.returncode == 0, again.stderr
    assert _outcomes("run") == expected
    (line, *_) = Path("run/trials.jsonl").read_text("utf-8").splitlines()
    assert _run("replay", "run", "--trial", json.loads(line)["trial"]).returncode == 0


@pytest.mark.parametrize(
    ("robot", "told"),
    [
        ("carriers:Carier", ["Carier", "did you mean 'Carrier'"]),
        ("carriers:carrier", ["not a class"]),
        ("carriers:Idle", ["begin", "act"]),
        ("carriers:Tall", ["height"]),
        ("carriers:Secretive", ["capabilities"]),
        ("carriers:Carrier.Inner", ["Inner"]),
        ("carriers:", ["module:Class"]),
        ("car riers:Carrier", ["module:Class"]),
        ("carriers.Carrier", ["module:Class", "carriers:Carrier"]),
        ("nowhere.carriers:Carrier", ["nowhere"]),
        ("broken:Carrier", ["ZeroDivisionError"]),
        ("leaving:Carrier", ["SystemExit"]),
        ("needy:Carrier", ["needy", "no_such_library"]),
        ("unable:Carrier", ["resolutions", "coarse, fine"]),
        ("traditonal", ["did you mean 'traditional'"]),
    ],
)
def test_each_mistake_is_one_line_with_its_key(robot: str, told: list[str]) -> None:
    _module("carriers")
    _module("broken", "1 / 0\n")
    _module("leaving", "raise SystemExit\n")
    _module("needy", "import no_such_library\n")
    _module("unable", ROBOT.format(able="resolutions=('rough',)"))
    line = _refused("check", "beside/pots.yaml", f"robots=[intentional,'{robot}']")
    assert "robots[1]" in line
    assert all(part in line for part in told), line


@pytest.mark.parametrize(
    ("able", "asked", "key"),
    [
        ("resolutions=('fine',)", "seed=1", "robots[0]"),
        ("knowledge=('complete',)", "knowledge=seen", "robots[0]"),
        ("needs_goal_feedback=True", "goal_feedback=false", "robots[0]"),
        ("first_action_step=4", "script=[{step: 3, action: 'blow(rose,sill)'}]", "script[0].step"),
    ],
)
def test_a_robot_is_asked_for_nothing_that_it_cannot(able: str, asked: str, key: str) -> None:
    name = f"limited_{able.partition('=')[0]}"  # a process imports a module once
    _module(name, ROBOT.format(able=able))
    asking = ["beside/pots.yaml", "scenarios=null", f"robots=[{name}:Carrier]", asked]
    for command in ("check", "run"):
        line = _refused(command, *asking)
        assert key in line
        assert f"{name}:Carrier" in line


def _distribution(site: Path, name: str, point: str, group: str = "robots") -> None:
    """What an installed distribution says of itself."""
    about = site / f"{name}-1.0.dist-info"
    about.mkdir(parents=True)
    about.joinpath("METADATA").write_text(f"Metadata-Version: 2.1\nName: {name}\nVersion: 1.0\n")
    about.joinpath("entry_points.txt").write_text(f"[intention_testbed.{group}]\n{point}\n")


def test_a_robot_of_an_installed_distribution_is_found_by_its_name(tmp_path: Path) -> None:
    _module("carriers_of_pots")
    _distribution(tmp_path / "site", "pot-carriers", f"carrying = {CARRIER}")
    path = os.pathsep.join([str(tmp_path / "site"), str(ROOT)])
    run = ["run", "beside/pots.yaml", "robots=[carrying]", "--out", "run", "--quiet"]
    done = _run(*run, PYTHONPATH=path)
    assert done.returncode == 0, done.stderr
    assert _outcomes("run") == {"carrying": "achieved"}
    line = _run("check", "beside/pots.yaml", "robots=[carying]", PYTHONPATH=path).stderr
    assert "did you mean 'carrying'" in line


@pytest.mark.parametrize(("first", "second"), [("carrying", "carrying"), ("else", "traditional")])
def test_a_name_that_two_distributions_claim_is_refused(
    tmp_path: Path, first: str, second: str
) -> None:
    """Also one of ours: that it has another meaning now would go unnoticed."""
    _distribution(tmp_path / "site", "pot-carriers", f"{first} = {CARRIER}")
    _distribution(tmp_path / "site", "more-carriers", f"{second} = {CARRIER}")
    path = os.pathsep.join([str(tmp_path / "site"), str(ROOT)])
    done = _run("check", "beside/pots.yaml", f"robots=[{second}]", PYTHONPATH=path)
    assert done.returncode == 2
    (line,) = done.stderr.splitlines()
    assert "more-carriers" in line
    assert "robots[0]" in line


def test_a_process_that_is_to_serve_a_robot_that_there_is_not_is_refused() -> None:
    line = _refused("robot", "--name", "carriers_of_pots:Nobody")
    assert "carriers_of_pots" in line


def test_a_process_serves_the_robot_that_it_is_called_after_and_no_other(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """Its module lies in the working directory."""
    _module("carriers_of_pots")
    monkeypatch.chdir("beside")
    name = "carriers_of_pots:Carrier"
    with open_driver() as session:
        command = [sys.executable, "-P", "-m", "testbed", "robot", "--name", name]
        command += ["--connect", endpoint(session)]
        with subprocess.Popen(command, stderr=subprocess.DEVNULL) as process:
            try:
                with closing(RemoteRobot(session, "run", name, PATIENCE_S)) as robot:
                    assert robot.wait(PATIENCE_S)
                    robot.begin(_task("t1", name))
                    step = Percept(trial="t1", step=1, visible=["-stands(fern,sill)"])
                    assert robot.ask(step).action == "carry(gardener,fern,sill)"
                    robot.begin(_task("t2", "traditional"))
                    with pytest.raises(RobotLost, match="traditional"):
                        robot.ask(Percept(trial="t2", step=1, visible=[]))
            finally:
                process.kill()


def _task(trial: str, robot: str) -> Task:
    return Task(
        trial=trial,
        robot=robot,
        domain="pots",
        source=GREENHOUSE,
        goal=["stands(fern,sill)"],
        initial=["stands(fern,bench)"],
        plan_limit=3,
        seed=0,
    )
