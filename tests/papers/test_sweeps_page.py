"""The page of the packaged sweeps: its numbers are those of the summary."""

import json
from pathlib import Path

import pytest

from papers.sweeps import main, study_of
from testbed.config import load_config
from testbed.experiment.runner import run
from testbed.report import write_report

OVERRIDES = ["limit=3", "sweep.grid={adversary.rate: [0.0, 0.5, 1.0]}"]


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The folder of a small run of a study, with its report."""
    where = tmp_path_factory.mktemp("rate")
    config = load_config("rate", OVERRIDES)
    run(config, where, workers=0)
    write_report(where, config)
    return where


def test_shares_of_the_page_are_those_of_the_summary(
    folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main([str(folder)]) == 0
    page, study = capsys.readouterr().out, study_of(folder)
    told = json.loads((folder / "summary.json").read_text(encoding="utf-8"))
    for condition, own in told["conditions"].items():
        (line,) = (each for each in page.splitlines() if each.startswith(f"| {condition} |"))
        assert f"| {own['pairs']} |" in line
        for robot, share in own["achieved"].items():
            assert study.share(condition, robot) == f"{share['value']:.0%}"
            assert f"| {share['value']:.1%}" in line
    assert told["digest"] in page
    assert "limit=3" in page


def test_a_run_that_is_no_sweep_is_refused_in_one_line(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    run(load_config("quickstart", ["scenarios=[1]", "link=inprocess"]), tmp_path, workers=0)
    assert main([str(tmp_path)]) == 2
    assert capsys.readouterr().err.count("\n") == 1
