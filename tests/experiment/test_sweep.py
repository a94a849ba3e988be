"""A swept run: the same trials under each condition, all in one folder."""

from pathlib import Path

import polars as pl
import pytest

from testbed.analysis import load_run
from testbed.config import load_config
from testbed.experiment.plan import plan_trials, planned_trials, sweep_findings
from testbed.experiment.replay import list_trials, replay, stored_trial
from testbed.experiment.runner import run
from testbed.experiment.store import read_records
from tests.config.test_sweep import written

SWEEP = """\
link: inprocess
seed: 7
limit: 3
sweep:
  grid: {adversary.rate: [0, 0.5], knowledge: [complete, seen]}
"""


def test_conditions_share_starts_and_seeds_and_no_trial(tmp_path: Path) -> None:
    config = load_config(written(tmp_path, SWEEP))
    specs = plan_trials(config)
    assert len(specs) == 4 * 3 * 2 == sum(planned_trials(config).values())
    assert len({spec.trial for spec in specs}) == len(specs)
    starts = {
        cell: [(own.seed, own.initial, own.robot) for own in specs if own.cell == cell]
        for cell in {spec.cell for spec in specs}
    }
    first, *others = starts.values()
    assert len(others) == 3
    assert all(other == first for other in others)


def test_a_condition_is_the_same_trials_as_a_run_of_its_own(tmp_path: Path) -> None:
    path = written(tmp_path, SWEEP)
    own = {spec.trial for spec in plan_trials(load_config(path)) if spec.setting.rate == 0.5}
    alone = ["sweep={}", "adversary.rate=0.5"]
    lone = [load_config(path, [*alone, f"knowledge={k}"]) for k in ("complete", "seen")]
    assert own == {spec.trial for config in lone for spec in plan_trials(config)}


def test_conditions_that_play_the_same_trials_are_told(tmp_path: Path) -> None:
    sweep = "sweep: {conditions: {one: {adversary.rate: 0.1}, two: {adversary.rate: 0.1}}}\n"
    ((key, told),) = sweep_findings(load_config(written(tmp_path, sweep)))
    assert key == ("sweep",)
    assert "'one'" in told
    assert "'two'" in told


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    """The folder of a swept run."""
    config = load_config(written(tmp_path, SWEEP))
    assert run(config, tmp_path / "run", workers=0).exit_code == 0
    return tmp_path / "run"


def test_the_condition_stands_in_columns(folder: Path) -> None:
    found = load_run(folder)
    told = found.trials.group_by("cell", "condition.rate", "condition.knowledge").len()
    assert sorted(told["condition.rate"].to_list()) == [0.0, 0.0, 0.5, 0.5]
    assert told["len"].to_list() == [6] * 4
    assert found.trials.filter(pl.col("condition.rate") == 0.0)["exogenous"].list.len().sum() == 0
    assert list(found.records()) == list(read_records(folder))


def test_a_swept_run_goes_on_and_its_trials_are_found(folder: Path) -> None:
    lines = (folder / "trials.jsonl").read_bytes().splitlines(keepends=True)
    (folder / "trials.jsonl").write_bytes(b"".join(lines[:10]))
    config = load_config(folder / "config.yaml")
    run(config, folder, workers=0, resume=True)
    assert len(list(read_records(folder))) == len(lines)
    last = list(read_records(folder))[-1]
    spec, record = stored_trial(folder, last.trial)
    assert record == last
    assert spec.cell == last.cell == "adversary.rate=0.5, knowledge=seen"


def test_a_list_of_trials_and_a_replay_tell_the_condition(
    folder: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("COLUMNS", "200")
    listed: list[str] = []
    list_trials(folder, listed.append)
    rows = [line for line in listed if "adversary.rate=0.5, knowledge=seen" in line]
    assert len(rows) == 6
    told: list[str] = []
    assert replay(folder, rows[0].split()[0], told.append)
    assert "adversary.rate=0.5, knowledge=seen" in told[0]
