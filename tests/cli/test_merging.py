"""Parts of a run that are played by themselves, and merged: the run that nothing disturbed."""

import json
import shutil
from pathlib import Path

import pytest
from typer.testing import CliRunner

from testbed.cli import app
from testbed.config import load_config
from testbed.experiment import run
from testbed.experiment.digest import logical
from testbed.experiment.shard import Shard
from testbed.experiment.store import read_records
from tests.pots import write_pots

COUNT = 5


def _invoke(*arguments: str) -> tuple[int, list[str]]:
    done = CliRunner().invoke(app, list(arguments))
    return done.exit_code, done.stderr.splitlines()


def _refused(*arguments: str) -> str:
    code, (line,) = _invoke(*arguments)
    assert code == 2
    return line


def _records(folder: Path) -> list[dict[str, object]]:
    return [logical(record) for record in read_records(folder)]


@pytest.fixture(scope="module")
def played(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A run, and the same in parts."""
    folder = tmp_path_factory.mktemp("played")
    file = write_pots(folder / "beside")
    config = load_config(file)
    run(config, folder / "whole", workers=0)
    assert _invoke("report", str(folder / "whole"))[0] == 0
    for number in range(2, COUNT + 1):
        run(config, folder / f"part-{number}", workers=0, shard=Shard(number, COUNT))
    first = ["--shard", f"1/{COUNT}", "--out", str(folder / "part-1"), "--quiet"]
    assert _invoke("run", str(file), *first) == (0, [])
    return folder


@pytest.fixture
def parts(played: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> list[str]:
    """The parts, to be changed."""
    monkeypatch.chdir(tmp_path)
    for number in range(1, COUNT + 1):
        shutil.copytree(played / f"part-{number}", f"part-{number}")
    return [f"part-{number}" for number in range(1, COUNT + 1)]


def test_parts_merge_to_the_run_that_nothing_disturbed(played: Path, parts: list[str]) -> None:
    assert _invoke("merge", *reversed(parts), "-o", "merged") == (0, [])
    assert _records(Path("merged")) == _records(played / "whole")
    summaries = [
        json.loads((own / "summary.json").read_text()) for own in (Path("merged"), played / "whole")
    ]
    assert summaries[0]["trials"] == summaries[1]["trials"] == 36
    assert len(json.loads(Path("merged/provenance.json").read_text())["before"]) == COUNT


def test_the_robots_of_a_pair_play_in_one_part(parts: list[str]) -> None:
    for part in parts:
        robots = {}
        for record in read_records(Path(part)):
            robots.setdefault(record.pair, set()).add(record.robot)
        assert robots
        assert all(len(own) == 2 for own in robots.values())


def test_a_part_that_is_missing_is_named(parts: list[str]) -> None:
    line = _refused("merge", *parts[1:], "-o", "merged")
    assert "28 of 36" in line
    assert not Path("merged").exists()


def test_a_trial_of_two_parts_is_refused(parts: list[str]) -> None:
    shutil.copytree(parts[0], "again")
    line = _refused("merge", *parts, "again", "-o", "merged")
    assert line.startswith("again: ")
    assert parts[0] in line


def test_parts_of_another_configuration_are_refused(parts: list[str]) -> None:
    config = Path("part-3/config.yaml")
    config.write_text(config.read_text().replace("rate: 0.3", "rate: 0.4"))
    line = _refused("merge", *parts, "-o", "merged")
    assert line.startswith("part-3: ")
    assert "adversary.rate" in line


def test_parts_played_with_other_versions_are_refused(parts: list[str]) -> None:
    file = Path("part-2/provenance.json")
    told = json.loads(file.read_text())
    told["versions"]["clingo"] = "0.0.1"
    file.write_text(json.dumps(told))
    line = _refused("merge", *parts, "-o", "merged")
    assert line.startswith("part-2: ")
    assert "clingo 0.0.1" in line


def test_nothing_is_merged_into_a_run(parts: list[str]) -> None:
    assert _refused("merge", *parts, "-o", parts[0]).startswith(parts[0])


@pytest.mark.parametrize("shard", ["0/3", "4/3", "1", "a/b", "-1/3"])
def test_a_shard_that_there_is_not_is_refused(tmp_path: Path, shard: str) -> None:
    config = str(write_pots(tmp_path / "beside"))
    line = _refused("run", config, f"--shard={shard}", "--out", str(tmp_path / "run"))
    assert line.startswith("--shard: ")
