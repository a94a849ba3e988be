"""What a run answers: numbers counted by hand, told in the summary, the page and the terminal."""

import json
from collections.abc import Iterable, Sequence
from html import unescape
from pathlib import Path
from typing import Any

import pytest

from testbed.analysis import load_run
from testbed.analysis.contestants import contrasts
from testbed.config import load_config
from testbed.experiment.record import TrialRecord
from testbed.experiment.runner import run
from testbed.experiment.store import TrialWriter
from testbed.report import write_report
from tests.config.test_sweep import written
from tests.experiment.samples import a_record

GOAL = 'goal=["stands(fern,sill)", "stands(rose,floor)"]'
SWEPT = "sweep: {grid: {adversary.rate: [0.1, 0.5, 0.9]}}\n"
RATES = ["adversary.rate=0.1", "adversary.rate=0.5", "adversary.rate=0.9"]


def _pairs(failures: Sequence[int], number: int = 20, cell: str = "") -> Iterable[TrialRecord]:
    """The intentional robot achieves its goal by 10 units; the other one needs 20, or fails early.

    `failures` are the pairs in which it does.
    """
    for n in range(number):
        own: dict[str, Any] = {
            "pair": f"{cell} {n}",
            "scenario": "random",
            "domain": "greenhouse",
            "initial": [f"stands(fern,place{n})"],
            "cell": cell,
        }
        yield a_record(f"i {cell} {n}", execution_units=10, **own)
        lost = n in failures
        units, outcome = (1, "gave_up") if lost else (20, "achieved")
        own |= {"achieved": not lost, "correct": not lost, "outcome": outcome}
        yield a_record(f"t {cell} {n}", robot="traditional", execution_units=units, **own)


def _reported(folder: Path, records: Iterable[TrialRecord], sweep: str = "") -> Any:
    """The summary of a run of these records."""
    config = load_config(written(folder, sweep))
    (folder / "run").mkdir()
    with TrialWriter(folder / "run") as writer:
        for record in records:
            writer.append(record)
    write_report(folder / "run", config)
    return _summary(folder / "run")


def _summary(folder: Path) -> Any:
    return json.loads((folder / "summary.json").read_text(encoding="utf-8"))


def test_who_achieves_more_and_who_needs_less_where_both_achieve(tmp_path: Path) -> None:
    success, cost = _reported(tmp_path, _pairs(range(12)))["answers"]
    assert [own["question"] for own in (success, cost)] == ["success", "cost"]
    (told,) = success["differ"]
    assert (told["pairs"], told["treatment_achieved"]["value"]) == (20, 1.0)
    assert told["baseline_achieved"]["value"] == pytest.approx(8 / 20)
    # Twelve differences of one sign are 2 of 2^12 equally likely ways, eight are 2 of 2^8; Holm's
    # correction doubles the smaller of these two p-values.
    assert (told["p"], told["holm"]) == pytest.approx((2 / 2**12, 4 / 2**12))
    (told,) = cost["differ"]
    assert (told["pairs"], told["ratio"]) == (8, {"value": 2.0, "low": 2.0, "high": 2.0})
    assert told["holm"] == pytest.approx(2 / 2**8)
    assert all(text in success["sentence"] for text in ("100%", "20", "40%"))
    assert all(text in cost["sentence"] for text in ("8", "2.00", "95%"))


def test_a_trial_that_failed_early_is_not_cheap(tmp_path: Path) -> None:
    group = _reported(tmp_path, _pairs(range(12)))["scenarios"]["random"]
    assert (group["pairs"], group["both_achieve"]) == (20, 8)
    assert group["ratios"]["execution_units"] == 2.0
    assert group["ratios_of_sums"]["execution_units"] == 2.0
    assert group["effects"]["execution_units"] == 1.0


@pytest.mark.parametrize(("failures", "number"), [((), 1), ((0,), 1), (range(5), 5)])
def test_where_nothing_is_significant_nothing_is_said(
    tmp_path: Path, failures: Sequence[int], number: int
) -> None:
    summary = _reported(tmp_path, _pairs(failures, number))
    assert summary["answers"] == []
    page = (tmp_path / "run" / "report.html").read_text(encoding="utf-8")
    assert 'class="answers"' not in page


def test_the_page_answers_first(tmp_path: Path) -> None:
    answers = _reported(tmp_path, _pairs(range(12)))["answers"]
    page = unescape((tmp_path / "run" / "report.html").read_text(encoding="utf-8"))
    for own in answers:
        assert page.index("</h1>") < page.index(own["sentence"]) < page.index("<h2")


def test_of_a_sweep_it_is_told_where_the_robots_begin_to_differ(tmp_path: Path) -> None:
    failures = dict(zip(RATES, ((), range(12), range(16)), strict=True))
    records = (own for cell, which in failures.items() for own in _pairs(which, 20, cell))
    answers = _reported(tmp_path, records, SWEPT)["answers"]
    overall, curve = (own for own in answers if own["question"] == "success")
    assert overall["differ"][0]["pairs"] == 60
    assert [own["condition"] for own in curve["differ"]] == RATES[1:]
    shares = [own["baseline_achieved"]["value"] for own in curve["differ"]]
    assert shares == pytest.approx([8 / 20, 4 / 20])
    assert curve["conditions"] == 3
    for text in (*RATES[1:], "2 of 3", "40%", "20%"):
        assert text in curve["sentence"]


def _played(folder: Path, *overrides: str) -> Path:
    config = load_config(written(folder), ["link=inprocess", "limits.steps=8", GOAL, *overrides])
    run(config, folder / "run", workers=0)
    write_report(folder / "run", config)
    return folder / "run"


def test_a_population_that_is_played_exhaustively_has_no_interval(tmp_path: Path) -> None:
    folder = _played(tmp_path, "adversary.rate=0")
    summary = _summary(folder)
    assert summary["exhaustive"] == ["random"]
    (found,) = contrasts([load_run(folder)])
    assert found.pairs > 1
    assert found.treatment is not None
    assert (found.treatment.value, found.treatment.ends) == (1.0, ())
    assert found.ratios["actions"].mean is not None
    assert found.ratios["actions"].mean.ends == ()
    assert "95%" not in (folder / "report.html").read_text(encoding="utf-8")


@pytest.mark.parametrize("overrides", [["adversary.rate=0.5"], ["adversary.rate=0", "limit=3"]])
def test_what_is_drawn_or_played_in_part_has_an_interval(
    tmp_path: Path, overrides: list[str]
) -> None:
    folder = _played(tmp_path, *overrides)
    assert _summary(folder)["exhaustive"] == []
    (found,) = contrasts([load_run(folder)])
    assert found.treatment is not None
    assert len(found.treatment.ends) == 2


def test_conditions_under_which_nothing_is_drawn_have_no_interval(tmp_path: Path) -> None:
    path = written(tmp_path, "sweep: {grid: {adversary.rate: [0, 0.9]}}\n")
    config = load_config(path, ["link=inprocess", "limits.steps=8", GOAL])
    run(config, tmp_path / "run", workers=0)
    write_report(tmp_path / "run", config)
    summary = _summary(tmp_path / "run")
    still, stormy = summary["conditions"].values()
    assert {own["low"] for own in still["achieved"].values()} == {None}
    assert None not in {own["low"] for own in stormy["achieved"].values()}
    assert summary["exhaustive"] == []
