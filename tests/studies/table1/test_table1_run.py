"""The protocol at a small size: the same results wherever it is played, also after a kill."""

import subprocess
import sys
from pathlib import Path

import pytest

from benchmarks.killing import killed_at
from papers.table1.__main__ import main
from papers.table1.pairs import each
from testbed.analysis import load_run
from testbed.analysis.pairs import Compared
from testbed.config import ExperimentConfig, load_config
from testbed.experiment.digest import digest
from testbed.experiment.plan import plan_trials
from testbed.experiment.run_folder import write_config
from testbed.experiment.runner import play_missing
from testbed.experiment.store import read_records
from testbed.studies.table1.pairs import pairs_in
from testbed.world import load_world
from tests.papers.prose import says

SMALL = ["limit=3", "repeats=2", "scenario_settings={}"]


def _config(*overrides: str) -> ExperimentConfig:
    return load_config("table1", [*SMALL, *overrides])


def _run(config: ExperimentConfig, folder: Path, workers: int = 1) -> str:
    write_config(folder, config)
    play_missing(config, folder, workers, lambda _: None)
    return digest(read_records(folder))


@pytest.fixture(scope="module")
def here(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The small protocol, played in this process."""
    folder = tmp_path_factory.mktemp("here")
    _run(_config(), folder)
    return folder


def test_the_intentional_robot_never_fails_with_feedback(here: Path) -> None:
    records = [r for r in read_records(here) if r.robot == "intentional"]
    assert len(records) == 6 * 3
    assert [r.trial for r in records if not r.correct] == []


def test_the_traditional_robot_fails_where_the_goal_was_undone(here: Path) -> None:
    trials = load_run(here).trials
    robots = Compared("traditional", "intentional")
    pairs = list(each(pairs_in(trials, load_world("office"), robots, ())))
    assert len(pairs) == 6 * 3
    assert any(pair.baseline.undone for pair in pairs)
    for pair in pairs:
        assert pair.baseline.correct != pair.baseline.undone
        assert pair.meeting in ("nothing", "same")


@pytest.mark.parametrize(("link", "workers"), [("inprocess", 2), ("zenoh", 1), ("zenoh", 2)])
def test_the_results_are_the_same_wherever_it_is_played(
    tmp_path: Path, here: Path, link: str, workers: int
) -> None:
    assert _run(_config(f"link={link}"), tmp_path, workers) == digest(read_records(here))


@pytest.mark.load
@pytest.mark.parametrize(("link", "workers"), [("inprocess", 1), ("inprocess", 2), ("zenoh", 2)])
def test_a_driver_killed_in_the_middle_goes_on_to_the_same_results(
    tmp_path: Path, here: Path, link: str, workers: int
) -> None:
    folder = tmp_path / "run"
    arguments = ["run", "table1", *SMALL, f"link={link}"]
    arguments += ["--out", str(folder), "--workers", str(workers), "--quiet"]
    kept = killed_at(5, arguments, folder)
    assert kept.count(b"\n") == 5 < len(plan_trials(_config()))
    testbed = (sys.executable, "-m", "testbed")
    assert subprocess.run([*testbed, *arguments, "--resume"], check=False).returncode == 0
    assert (folder / "trials.jsonl").read_bytes().startswith(kept)
    assert digest(read_records(folder)) == digest(read_records(here))


def test_the_page_is_made_from_a_run(here: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main([str(here), "--unaided", str(here), "--later", str(here)]) == 0
    page = capsys.readouterr().out
    assert says(page, 0, 18)
    assert "testbed run table1 repeats=2 limit=3" in page
    for heading in ("## Triggered scenarios", "## Row by row", "## Without goal feedback"):
        assert heading in page


def test_the_page_needs_a_run_of_the_protocol(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main([str(tmp_path)]) == 2
    assert "is not a run folder" in capsys.readouterr().err
    write_config(tmp_path, load_config("office"))
    assert main([str(tmp_path)]) == 2
    assert "has no `protocol: table1`" in capsys.readouterr().err
    write_config(tmp_path, _config())
    assert main([str(tmp_path)]) == 2
    assert "has no pairs of intentional and traditional" in capsys.readouterr().err
