"""What is imported: the packages of this distribution, whatever lies about."""

import os
import subprocess
import sys
from pathlib import Path

import pytest
from typer.testing import CliRunner

from testbed.cli import app
from testbed.registry import PATH_VARIABLE

RUN = ["run", "quickstart", "scenarios=[1]", "--workers", "2", "--out", "run"]
ROOT = Path(__file__).parents[2]


@pytest.fixture(autouse=True)
def _elsewhere(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Commands run in a folder of the test's own; what they change of this process is undone."""
    monkeypatch.setenv("PYTHONPATH", str(ROOT))
    monkeypatch.setenv(PATH_VARIABLE, "")
    monkeypatch.setattr(sys, "path", list(sys.path))
    monkeypatch.chdir(tmp_path)


def _package(folder: Path, name: str) -> Path:
    """A package that can be found and not be imported."""
    file = folder / name / "__init__.py"
    file.parent.mkdir(parents=True)
    file.write_text("raise SystemExit('shadowed')\n", encoding="utf-8")
    return file


def _do(*command: str, **environment: str) -> subprocess.CompletedProcess[str]:
    return subprocess.run(
        [sys.executable, *command],
        check=False,
        capture_output=True,
        text=True,
        env={**os.environ, **environment},
    )


def test_what_lies_in_the_working_directory_does_no_harm(tmp_path: Path) -> None:
    for name in ("agents", "asp", "testbed", "zenoh", "pickle", "typing"):
        _package(tmp_path, name)
    done = _do("-P", "-m", "testbed", *RUN)
    assert done.returncode == 0, done.stderr


@pytest.mark.parametrize("name", ["agents", "asp"])
def test_a_package_in_the_place_of_ours_is_told_in_one_line(tmp_path: Path, name: str) -> None:
    """`python -m` looks into the working directory first."""
    file = _package(tmp_path, name)
    done = _do("-m", "testbed", *RUN, PYTHONPATH="")
    assert (done.returncode, done.stdout) == (2, "")
    assert len(done.stderr.splitlines()) == 1
    assert str(file) in done.stderr
    assert not Path("run").exists()


def test_the_distribution_that_owns_a_name_of_ours_is_told(tmp_path: Path) -> None:
    site = tmp_path / "site"
    file = _package(site, "agents")
    about = site / "elsewhere_agents-1.0.dist-info"
    about.mkdir()
    about.joinpath("METADATA").write_text("Metadata-Version: 2.1\nName: elsewhere-agents\n")
    about.joinpath("top_level.txt").write_text("agents\n")
    done = _do("-P", "-m", "testbed", *RUN, PYTHONPATH=os.pathsep.join([str(site), str(ROOT)]))
    assert (done.returncode, len(done.stderr.splitlines())) == (2, 1)
    assert str(file) in done.stderr
    assert "elsewhere-agents" in done.stderr


def test_the_folder_of_a_configuration_is_searched_last(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """In the driver, and in a robot that it starts."""
    folder = tmp_path / "own"
    folder.mkdir()
    source = folder / "own.yaml"
    source.write_text('name: own\ngoal: ["loc(book1,library)"]\n', encoding="utf-8")
    before = list(sys.path)
    assert CliRunner().invoke(app, ["check", str(source)]).exit_code == 0
    assert sys.path == [*before, str(folder)]
    sys.path.remove(str(folder))
    monkeypatch.setattr("testbed.link.session.CONNECT_S", 0.1)
    assert CliRunner().invoke(app, ["robot", "--connect", "tcp/127.0.0.1:1"]).exit_code == 2
    assert sys.path == [*before, str(folder)]
