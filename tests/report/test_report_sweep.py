"""The part of a report on a sweep: shares and ratios by condition, counted by hand."""

import json
from pathlib import Path

import pytest

from testbed.analysis import load_run
from testbed.config import load_config
from testbed.experiment.runner import run
from testbed.report import write_report
from testbed.studies import results_of
from testbed.studies.sweeps import SWEEP, found_in
from tests.config.test_sweep import written

CONFIG = """\
link: inprocess
seed: 7
limit: 12
limits: {steps: 9}
sweep:
  grid: {knowledge: [complete, seen], adversary.rate: [0, 0.9]}
"""


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The folder of a swept run, with its report."""
    where = tmp_path_factory.mktemp("swept")
    config = load_config(
        written(where, CONFIG), ['goal=["stands(fern,sill)", "stands(rose,floor)"]']
    )
    run(config, where / "run", workers=0)
    write_report(where / "run", config)
    return where / "run"


def test_each_condition_has_the_shares_of_its_own_trials(folder: Path) -> None:
    found = load_run(folder)
    told = SWEEP.numbers(found_in(found))["conditions"]
    assert list(told) == list(found.config.sweep.cells)
    for name, own in told.items():
        assert own["keys"] == found.config.sweep.cells[name]
        counted = [record for record in found.records() if record.cell == name and record.steps > 1]
        for robot, share in own["achieved"].items():
            ours = [record.achieved for record in counted if record.robot == robot]
            assert share["value"] == pytest.approx(sum(ours) / len(ours))
            if share["low"] is not None:  # some are of a whole population
                assert share["low"] <= share["value"] <= share["high"]
    undisturbed = told["knowledge=complete, adversary.rate=0"]
    assert undisturbed["cost"]["value"] == 1.0
    assert {share["value"] for share in undisturbed["achieved"].values()} == {1.0}
    stormy = told["knowledge=complete, adversary.rate=0.9"]["achieved"]
    assert stormy["traditional"]["value"] < 1.0


def test_explanations_of_a_condition_are_of_all_events_of_its_trials(folder: Path) -> None:
    run = load_run(folder)
    told = json.loads((folder / "summary.json").read_text(encoding="utf-8"))["conditions"]
    rows = [row for row in run.trials.to_dicts() if row["steps"] > 1]
    seen = 0
    for name, own in told.items():
        for robot in run.config.robots:
            counted = [row for row in rows if row["cell"] == name and row["robot"] == robot]
            events = sum(row["quality.unobserved"] for row in counted)
            explained = sum(row["quality.explained"] for row in counted)
            share = own["explained"][robot]
            assert (
                share is None if not events else share["value"] == pytest.approx(explained / events)
            )
            seen += explained
    assert seen
    page = (folder / "report.html").read_text(encoding="utf-8")
    assert 'id="quality"' in page
    assert 'id="conditions-sheet-1"' in page


def test_a_figure_is_drawn_for_each_choice_of_the_other_keys(folder: Path) -> None:
    (section,) = SWEEP.sections(found_in(load_run(folder)))
    shares = [chart for chart in section.charts if chart.kind == "share curve"]
    assert [chart.under for chart in shares] == ["knowledge=complete", "knowledge=seen"]
    assert all(list(chart.places) == ["0", "0.9"] for chart in shares)
    page = (folder / "report.html").read_text(encoding="utf-8")
    assert 'id="conditions"' in page
    assert page.count("knowledge=seen, adversary.rate=0.9") >= 1


def test_a_run_without_a_sweep_has_no_such_part(tmp_path: Path) -> None:
    config = load_config(written(tmp_path, "link: inprocess\nlimit: 1\n"))
    run(config, tmp_path / "run", workers=0)
    assert not results_of(load_run(tmp_path / "run"))
