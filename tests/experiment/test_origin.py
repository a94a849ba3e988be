"""Where a record came from: versions, machine, load, revision, and hashes of what was read."""

import json
import os
import platform
import subprocess
from hashlib import sha256
from importlib.metadata import version
from pathlib import Path
from typing import Any

import pytest
from typer.testing import CliRunner

from benchmarks.own import Own
from testbed.cli import app
from testbed.experiment.digest import digest, logical
from testbed.experiment.origin import checked_out
from testbed.experiment.store import read_records
from tests.experiment.gardens import GARDEN, ROWS
from tests.greenhouse import GREENHOUSE

ROOT = Path(__file__).parents[2]
RAKED = GARDEN.replace("OTHER", "rake")
COARSE = {"scenarios": "none", "initial": ["stands(fern,bench)", "stands(rose,floor)"]}


def _origins(config: Path, folder: Path) -> list[dict[str, Any]]:
    """What the lines of a run tell of where they came from."""
    done = CliRunner().invoke(app, ["run", str(config), "--out", str(folder), "--quiet"])
    assert done.exit_code == 0, done.output
    lines = (folder / "trials.jsonl").read_text(encoding="utf-8").splitlines()
    return [json.loads(line)["origin"] for line in lines]


def _hash(file: Path) -> str:
    return sha256(file.read_bytes()).hexdigest()


def test_each_record_says_where_it_came_from(tmp_path: Path) -> None:
    config = Own(tmp_path, GREENHOUSE).write(goal=["stands(fern,sill)"], **COARSE)
    for origin in _origins(config, tmp_path / "run"):
        assert origin["versions"]["python"] == platform.python_version()
        assert origin["versions"]["clingo"] == version("clingo")
        assert origin["cpu"]
        assert 1 <= origin["cores"] <= (os.cpu_count() or 1)
        assert origin["load"] >= 0
        assert (origin["revision"], origin["dirty"]) == checked_out(ROOT)
        assert origin["config_sha256"] == _hash(tmp_path / "run/config.yaml")
        assert origin["domain_sha256"] == _hash(tmp_path / "run/own.al")
        assert origin["refinement_sha256"] is None


def test_a_refinement_has_a_hash_of_its_own(tmp_path: Path) -> None:
    config = Own(tmp_path, RAKED, ROWS).write(goal=["stands(spade,south)"], robots=["intentional"])
    (origin,) = _origins(config, tmp_path / "run")
    assert origin["domain_sha256"] == _hash(tmp_path / "run/own.al")
    assert origin["refinement_sha256"] == _hash(tmp_path / "run/own.fine")


def test_no_result_depends_on_the_origin(tmp_path: Path) -> None:
    config = Own(tmp_path, GREENHOUSE).write(goal=["stands(fern,sill)"], **COARSE)
    _origins(config, tmp_path / "run")
    first, second = read_records(tmp_path / "run")
    before = digest([first, second]), logical(first)
    assert first.origin is not None
    first.origin.cpu, second.origin = "an abacus", None
    assert (digest([first, second]), logical(first)) == before


@pytest.fixture
def checkout(tmp_path: Path) -> Path:
    """A repository with one revision."""
    commit = ["-c", "user.name=a", "-c", "user.email=a@b", "commit", "--quiet", "-m", "first"]
    (tmp_path / "code.py").write_text("one\n")
    for command in (["init", "--quiet"], ["add", "code.py"], commit):
        subprocess.run(["git", "-C", str(tmp_path), *command], check=True)
    return tmp_path


def test_a_checkout_is_dirty_where_a_tracked_file_differs(checkout: Path) -> None:
    asked = ["git", "-C", str(checkout), "rev-parse", "HEAD"]
    revision = subprocess.run(asked, check=True, capture_output=True, text=True).stdout.strip()
    (checkout / "notes.txt").write_text("mine\n")
    assert checked_out(checkout) == (revision, False)
    (checkout / "code.py").write_text("two\n")
    assert checked_out(checkout) == (revision, True)


def test_outside_a_checkout_there_is_no_revision(tmp_path: Path) -> None:
    assert checked_out(tmp_path) == (None, None)
