"""Runs at the fine resolution with real robots: the same wherever they are played."""

import json
import subprocess
import sys
from pathlib import Path

import pytest
from typer.testing import CliRunner

from benchmarks.killing import killed_at
from testbed.cli import app
from testbed.config import ExperimentConfig, load_config
from testbed.experiment.digest import digest, logical
from testbed.experiment.plan import plan_trials
from testbed.experiment.robots import make_robot
from testbed.experiment.run_folder import write_config
from testbed.experiment.runner import play_missing
from testbed.experiment.status import RunStatus
from testbed.experiment.store import read_records
from testbed.experiment.trial import play_trial
from testbed.link import InProcessRobot
from testbed.report import write_report

TESTBED = (sys.executable, "-m", "testbed")
LEVELS = ("L1", "L2", "L3", "L4", "L5", "L6", "L7", "L8")
SMALL = ("levels=[L1,L2]", "limit=2", "adversary.rate=0.2")


def _config(*overrides: str) -> ExperimentConfig:
    return load_config("levels", [*SMALL, *overrides])


def _run(config: ExperimentConfig, folder: Path, workers: int = 1) -> list[dict[str, object]]:
    play_missing(config, folder, workers, _ignore)
    return [logical(record) for record in read_records(folder)]


def _ignore(tally: RunStatus) -> None:
    del tally


@pytest.fixture(scope="module")
def here(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A run of both robots in this process."""
    folder: Path = tmp_path_factory.mktemp("levels")
    config = _config()
    write_config(folder, config)
    play_missing(config, folder, 1, _ignore)
    return folder


def _played(folder: Path) -> list[dict[str, object]]:
    return [logical(record) for record in read_records(folder)]


def test_every_trial_achieves_its_goal_with_and_without_zooming(here: Path) -> None:
    records = list(read_records(here))
    assert len(records) == 2 * 2 * 2
    assert {record.outcome for record in records} == {"achieved"}
    for record in records:
        assert record.fine is not None
        assert record.fine.actions >= record.action_count == len(record.actions)
        assert record.fine.plans >= record.action_count
        assert record.fine.planning_time_s > 0
        assert all(attempt.action in _abstract(record.level) for attempt in record.actions)


def _abstract(level: str) -> set[str]:
    rooms = {"L1": 2, "L2": 3}[level]
    objects = {"L1": 1, "L2": 2}[level]
    moves = {f"move(rob1,room{n})" for n in range(1, rooms + 1)}
    return moves | {
        f"{name}(rob1,object{n})" for name in ("pickup", "put_down") for n in range(1, objects + 1)
    }


def test_a_small_size_has_every_level() -> None:
    assert tuple(load_config("levels").levels) == LEVELS


@pytest.mark.parametrize("level", LEVELS)
def test_at_each_level_both_robots_achieve_what_is_in_reach(tmp_path: Path, level: str) -> None:
    play_missing(load_config("levels", [f"levels=[{level}]", "limit=1"]), tmp_path, 1, _ignore)
    records = list(read_records(tmp_path))
    assert sorted(record.robot for record in records) == ["intentional", "intentional-nozoom"]
    for record in records:
        assert record.level == level
        assert record.achieved or record.in_reach is False
        assert record.outcome == ("achieved" if record.achieved else "gave_up")


@pytest.mark.parametrize(("link", "workers"), [("zenoh", 1), ("inprocess", 2), ("zenoh", 2)])
def test_the_same_trials_come_out_wherever_they_are_played(
    tmp_path: Path, here: Path, link: str, workers: int
) -> None:
    assert _run(_config(f"link={link}"), tmp_path, workers) == _played(here)


@pytest.mark.load
def test_a_run_of_levels_goes_on_with_what_is_missing(tmp_path: Path, here: Path) -> None:
    lines = (here / "trials.jsonl").read_bytes().splitlines(keepends=True)
    write_config(tmp_path, _config())
    (tmp_path / "trials.jsonl").write_bytes(b"".join(lines[:5]) + lines[5][:40])
    resumed = ["run", str(tmp_path / "config.yaml"), "--out", str(tmp_path), "--resume", "--quiet"]
    assert CliRunner().invoke(app, resumed).exit_code == 0
    assert (tmp_path / "trials.jsonl").read_bytes().startswith(b"".join(lines[:5]))
    assert _played(tmp_path) == _played(here)


@pytest.mark.load
@pytest.mark.parametrize(("link", "workers"), [("inprocess", 1), ("zenoh", 2)])
def test_a_killed_run_of_levels_goes_on_to_the_same_results(
    tmp_path: Path, here: Path, link: str, workers: int
) -> None:
    arguments = ["run", "levels", *SMALL, f"link={link}"]
    arguments += ["--out", str(tmp_path), "--workers", str(workers), "--quiet"]
    kept = killed_at(2, arguments, tmp_path)
    assert kept.count(b"\n") == 2
    assert subprocess.run([*TESTBED, *arguments, "--resume"], check=False).returncode == 0
    whole = (tmp_path / "trials.jsonl").read_bytes()
    assert whole.startswith(kept)
    assert whole.count(b"\n") == len(plan_trials(_config()))
    assert digest(read_records(tmp_path)) == digest(read_records(here))


def test_summary_and_report_have_the_columns_of_the_levels(here: Path) -> None:
    tables = write_report(here, _config())
    summary = json.loads((here / "summary.json").read_text(encoding="utf-8"))
    assert set(summary["levels"]) == {"L1", "L2"}
    for level in summary["levels"].values():
        assert set(level["reasoning"]) == {"intentional", "intentional-nozoom"}
        assert all(ratio > 0 for ratio in level["zoom_ratios"].values())
    page = (here / "report.html").read_text(encoding="utf-8")
    assert "Reasoning at each level" in page
    assert "<h3>Level L1</h3>" in page
    # The published rows are left out, since here events happen more often.
    firsts = {row[0] for grid in tables.grids for row in grid.rows if row is not None}
    assert {"L1", "L2"} <= firsts
    assert not any("published" in first for first in firsts)


def test_a_replay_is_as_recorded(here: Path) -> None:
    first = next(read_records(here))
    told = CliRunner().invoke(app, ["replay", str(here), "--trial", first.trial])
    assert told.exit_code == 0, told.output
    assert told.output.rstrip().endswith("as recorded")
    for word in ("abstract", "relevant", "refined to", "observed", "inferred"):
        assert f"\n  {word}" in told.output


def test_what_is_found_on_the_way_does_not_end_the_way() -> None:
    """The robot believes the object in the last room, and sees it in the one that it crosses."""
    row = "level_sizes={row: {rooms: 3, rows: 1, columns: 2, objects: [[1, 1]]}}"
    config = load_config(
        "levels",
        [
            row,
            "levels=[row]",
            "limit=12",
            "robots=[intentional]",
            "initial=[fine_loc(rob1,room1_1), fine_loc(object1_1,room3_2)]",
            "goal=[loc(object1,room1)]",
            "statistics={fine_move: 0.5}",
            "adversary.rate=0.0",
            "script=[{step: 2, action: 'fine_exo_move(object1_1,room2_2)'}]",
        ],
    )
    robot = InProcessRobot(make_robot)
    outcomes = [play_trial(spec, robot).record.outcome for spec in plan_trials(config)]
    assert outcomes == ["achieved"] * 12
