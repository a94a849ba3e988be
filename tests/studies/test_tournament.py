"""The tournament: each adversary meets each robot, in any domain, and what is told is counted."""

import json
from collections.abc import Sequence
from pathlib import Path

import pytest

from papers.tournament import main
from testbed.analysis import load_run
from testbed.config import load_config
from testbed.experiment.record import TrialRecord
from testbed.experiment.runner import run
from testbed.experiment.store import read_records
from testbed.report import write_report
from testbed.report.figures import drawn
from testbed.studies import Chart, results_of
from tests import games

ADVERSARIES = {
    "none": {"adversary.strategy": "none"},
    "random": {"adversary.strategy": "random", "adversary.rate": 0.6},
    "greedy": {"adversary.strategy": "greedy"},
}
ROBOTS = ("intentional", "traditional")
MEASURES = {"achieved": "{:.0%}", "extra": "{:.1f}", "regret": "{:.1f}", "plans": "{:.1f}"}


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The folder of a tournament in a harbour, with its report."""
    where = tmp_path_factory.mktemp("tournament")
    keys = {
        "protocol": "tournament",
        "link": "inprocess",
        "repeats": 4,
        "initial": None,
        "limit": 6,
        "adversary": {"strategy": "none", "budget": 2, "fair": True},
        "sweep": {"conditions": ADVERSARIES, "grid": {"goal_feedback": [True, False]}},
    }
    config = load_config(games.config_of(where, "harbour", **keys))
    run(config, where / "run", workers=0)
    write_report(where / "run", config)
    return where / "run"


def _charts(folder: Path) -> Sequence[Chart]:
    (found,) = results_of(load_run(folder))
    (section,) = found.sections
    return section.charts


def _mean(records: Sequence[TrialRecord], measure: str) -> float | None:
    """The measure by hand, of trials of one robot under one condition."""
    values = {
        "achieved": [float(own.achieved) for own in records],
        "plans": [float(own.plans) for own in records],
        "extra": [own.execution_units - (own.minimal_units or 0) for own in _achieved(records)],
        "regret": [own.execution_units - (own.oracle_units or 0) for own in _achieved(records)],
    }[measure]
    return sum(values) / len(values) if values else None


def _achieved(records: Sequence[TrialRecord]) -> list[TrialRecord]:
    return [own for own in records if own.achieved]


def _counted(folder: Path) -> list[TrialRecord]:
    """The trials of pairs in which something can be done, and is to be."""
    records = [*read_records(folder)]
    idle = {own.pair for own in records if own.achieved and not (own.actions or own.activities)}
    hopeless = {own.pair for own in records if own.minimal_reason == "no plan"}
    return [own for own in records if own.pair not in idle | hopeless]


@pytest.mark.parametrize("measure", MEASURES)
def test_the_summary_has_what_the_records_come_to(folder: Path, measure: str) -> None:
    records = _counted(folder)
    told = json.loads((folder / "summary.json").read_text(encoding="utf-8"))["conditions"]
    assert len(told) == 2 * len(ADVERSARIES)
    for condition, own in told.items():
        for robot in ROBOTS:
            mine = [r for r in records if (r.cell, r.robot) == (condition, robot)]
            expected, value = _mean(mine, measure), own[measure][robot]
            assert (value and value["value"]) == (expected and pytest.approx(expected))


@pytest.mark.parametrize("measure", MEASURES)
def test_a_map_has_a_row_per_adversary_and_a_column_per_robot(folder: Path, measure: str) -> None:
    told = json.loads((folder / "summary.json").read_text(encoding="utf-8"))["conditions"]
    charts = [chart for chart in _charts(folder) if chart.name.startswith(measure)]
    assert len(charts) == 2
    for chart in charts:
        assert [*chart.places] == [*ADVERSARIES]
        assert [series.label for series in chart.series] == [*ROBOTS]
        figure = drawn(chart).svg
        for series in chart.series:
            for point in series.points:
                own = told[f"{point.place}, {chart.under}"][measure][series.label]
                assert point.value == own["value"]
                assert f">{MEASURES[measure].format(point.value)}</text>" in figure


def test_no_robot_needs_less_than_who_knows_all_events(folder: Path) -> None:
    achieved = _achieved([*read_records(folder)])
    assert any(own.exogenous for own in achieved)
    for own in achieved:
        assert own.oracle_units is not None
        assert own.execution_units >= own.oracle_units


def test_its_page_and_its_report_have_every_condition(
    folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    report = (folder / "report.html").read_text(encoding="utf-8")
    assert main([str(folder)]) == 0
    page = capsys.readouterr().out
    for condition in load_run(folder).config.sweep.cells:
        assert page.count(f"| {condition} |") == len(MEASURES)
        assert condition in report


def test_the_packaged_one_has_each_adversary_at_each_rate() -> None:
    config = load_config("tournament")
    adversaries, observability = config.sweep.axes
    strategies = {own["adversary.strategy"] for own in adversaries.points.values()}
    assert strategies == {"none", "random", "meddler", "belief", "greedy", "learned"}
    assert len(adversaries.points) == 11
    assert len(observability.points) == 2
