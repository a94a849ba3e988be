"""How much of a plan is on record: counted as the plan counts, and said wherever numbers are."""

import json
from pathlib import Path

import pytest
from typer.testing import CliRunner

from papers.levels.__main__ import main as levels_page
from papers.table1.__main__ import main as table1_page
from testbed.cli import app
from testbed.config import load_config
from testbed.experiment.plan import Coverage, coverage_of, plan_trials, planned_trials
from testbed.experiment.run_folder import write_config
from testbed.experiment.runner import play_missing
from testbed.experiment.timeline import place
from testbed.text import listed

LEVELS = ["levels=[L3,L1]", "limit=3"]
TABLE1 = ["limit=2", "repeats=1", "scenario_settings={}", "link=inprocess"]


@pytest.mark.parametrize(
    ("name", "overrides"),
    [
        ("quickstart", []),
        ("quickstart", ["robots=[intentional,intentional-checking,traditional]"]),
        ("office", []),
        ("office", ["limit=7", "repeats=3", "scenarios=[2,random,6]"]),
        ("table1", ["limit=100"]),
        ("table1", ["scenarios=[3,random]"]),
        ("levels", LEVELS),
        ("levels", ["levels=[L2]", "limit=4", "robots=[intentional]"]),
        ("levels", ["levels=[]", "refinement=office.fine", "limit=2"]),
    ],
)
def test_trials_are_counted_as_they_are_planned(name: str, overrides: list[str]) -> None:
    config = load_config(name, overrides)
    specs = plan_trials(config)
    places = [place(spec.scenario, spec.level) for spec in specs]
    counts = {where: places.count(where) for where in dict.fromkeys(places)}
    assert planned_trials(config) == counts
    assert list(planned_trials(config)) == list(counts)


def test_what_is_missing_is_told_by_scenario() -> None:
    own = Coverage("scenario", {"1": 4, "2": 4, "3": 4, "random": 8}, {"1": 4, "2": 3})
    assert own.numbers() == {"planned": 20, "missing": {"2": 1, "3": 4, "random": 8}}
    assert own.notice() == (
        "7 of 20 trials are on record: 3 of 4 of scenario 2, none of scenarios 3 and random"
    )


def test_a_complete_run_has_no_notice() -> None:
    own = Coverage("level", {"L1": 4, "L2": 2}, {"L2": 2, "L1": 4})
    assert own.numbers() == {"planned": 6, "missing": {}}
    assert own.notice() is None


def test_records_count_where_they_were_played() -> None:
    fine = coverage_of([("levels", "L3")], load_config("levels", LEVELS))
    assert fine.numbers() == {"planned": 12, "missing": {"L3": 5, "L1": 6}}
    assert fine.notice() == ("1 of 12 trials are on record: 1 of 6 of level L3, none of level L1")
    config = load_config("quickstart", ["scenarios=[6,2]"])
    coarse = coverage_of([("2", "coarse"), ("6", "coarse")], config)
    assert coarse.missing == {"6": 1, "2": 1}


@pytest.mark.parametrize(
    ("names", "text"),
    [([], ""), (["a"], "a"), (["a", "b"], "a and b"), (["a", "b", "c"], "a, b and c")],
)
def test_names_are_listed_in_words(names: list[str], text: str) -> None:
    assert listed(names) == text


@pytest.fixture(scope="module")
def part(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The first scenario and a trial of the second, of a run with more."""
    folder = tmp_path_factory.mktemp("part")
    config = load_config("table1", TABLE1)
    write_config(folder, config)
    play_missing(config.model_copy(update={"scenarios": config.scenarios[:2]}), folder, 1, _ignore)
    path = folder / "trials.jsonl"
    path.write_bytes(b"".join(path.read_bytes().splitlines(keepends=True)[:5]))
    return folder


def _ignore(_: object) -> None:
    pass


def _said(folder: Path) -> str:
    scenarios = load_config(folder / "config.yaml").scenarios
    return (
        f"5 of {4 * len(scenarios)} trials are on record: 1 of 4 of scenario {scenarios[1]}, "
        f"none of scenarios {listed(scenarios[2:])}"
    )


def test_the_report_says_that_a_run_is_not_complete(part: Path) -> None:
    done = CliRunner().invoke(app, ["report", str(part)])
    assert done.exit_code == 0, done.output
    assert f"incomplete: {_said(part)}" in done.output.splitlines()
    page = (part / "report.html").read_text(encoding="utf-8")
    assert _said(part) in page.partition("<nav")[0]
    summary = json.loads((part / "summary.json").read_text(encoding="utf-8"))
    planned = planned_trials(load_config("table1", TABLE1))
    assert (summary["trials"], summary["planned"]) == (5, sum(planned.values()))
    assert sum(summary["missing"].values()) == summary["planned"] - 5


def test_the_report_of_a_complete_run_says_nothing_of_it(tmp_path: Path) -> None:
    config = load_config("quickstart", ["link=inprocess", "scenarios=[1]"])
    write_config(tmp_path, config)
    play_missing(config, tmp_path, 1, _ignore)
    done = CliRunner().invoke(app, ["report", str(tmp_path)])
    assert "incomplete" not in done.output
    assert 'class="notice" role="note"' not in (tmp_path / "report.html").read_text(
        encoding="utf-8"
    )
    summary = json.loads((tmp_path / "summary.json").read_text(encoding="utf-8"))
    assert (summary["planned"], summary["missing"]) == (2, {})


def test_a_report_without_trials_has_no_table(tmp_path: Path) -> None:
    write_config(tmp_path, load_config("quickstart", ["scenarios=[1,2]"]))
    done = CliRunner().invoke(app, ["report", str(tmp_path)])
    assert done.output.splitlines() == [
        "incomplete: 0 of 4 trials are on record: none of scenarios 1 and 2",
        f"report: {tmp_path / 'report.html'}",
    ]


def test_the_page_of_table_1_says_it(part: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert table1_page([str(part)]) == 0
    head, _, _ = capsys.readouterr().out.partition("In each table")
    assert f"**Incomplete:** of `runs/table1` {_said(part)}." in " ".join(head.split())


def test_the_page_of_the_levels_says_it(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    config = load_config("levels", ["levels=[L1,L3]", "limit=2"])
    write_config(tmp_path, config)
    play_missing(config.model_copy(update={"levels": ("L1",)}), tmp_path, 1, _ignore)
    assert levels_page([str(tmp_path)]) == 0
    head, _, _ = capsys.readouterr().out.partition("## What can")
    assert "**Incomplete:** 4 of 8 trials are on record: none of level L3." in head
