"""The comparison of the robots: numbers of one precision, rows of scenarios and of all."""

import re
from typing import Any

import pytest

from testbed.analysis.comparison import COUNTS, MEASURES
from testbed.experiment.record import Outcome, TrialRecord
from testbed.report.comparison import groups_of, optima
from testbed.report.page import environment
from tests.experiment.samples import a_record, summary_of


def _pairs(scenario: str, count: int, actions: int) -> list[TrialRecord]:
    return [
        a_record(
            f"{robot} {scenario} {number}",
            pair=f"{scenario} {number}",
            initial=[f"state {number}"],
            scenario=scenario,
            robot=robot,
            action_count=needed,
            correct=robot == "intentional",
        )
        for number in range(count)
        for robot, needed in (("intentional", actions), ("traditional", 10 + number))
    ]


ROW = re.compile(
    r"<tr>\s*<th[^>]* data-label=.scenario.><div>(.*?)</div></th>(.*?)</tr>", re.DOTALL
)
CELL = re.compile(r'data-label="([^"]+)"><div>(.*?)(?: <small>(.*?)</small>)?</div>')


def _shown(summary: Any) -> dict[str, dict[str, tuple[str, str]]]:
    """The cells of the table in a page, by row and column: the value, and what is below it."""
    robots = {role: summary[role] for role in ("baseline", "treatment")}
    page = (
        environment()
        .get_template("comparison.html.j2")
        .render(
            compared=groups_of(summary),
            counts=COUNTS,
            measures=list(MEASURES),
            compared_charts=[],
            optima=[],
            exhaustive=[],
            **robots,
        )
    )
    rows = {name: CELL.findall(cells) for name, cells in ROW.findall(page)}
    return {name: {own[0]: own[1:] for own in cells} for name, cells in rows.items()}


def test_shares_ratios_and_chances_have_one_precision() -> None:
    cells = _shown(summary_of(_pairs("2", 12, 3)))["2"]
    assert cells["pairs"] == ("12", "")
    assert cells["intentional correct"] == ("100.0 %", "+1.00 (p &lt; 0.001)")
    assert cells["traditional correct"] == ("0.0 %", "")
    # The mean of 10/3 to 21/3; twelve differences of one sign are 2 of 2^12 equally likely ways.
    assert cells["actions"] == ("5.17", "+1.00 (p &lt; 0.001)")
    assert cells["plans"] == ("-", "")


def test_a_single_pair_has_no_chance() -> None:
    assert _shown(summary_of(_pairs("2", 1, 5)))["2"]["actions"] == ("2.00", "")


def test_trials_of_which_it_is_not_known_are_told() -> None:
    records = _pairs("2", 3, 5)
    records[0].correct = None
    assert _shown(summary_of(records))["2"]["intentional correct"][1].endswith("1 not decided")


@pytest.mark.parametrize("outcome", ["robot_lost", "error"])
@pytest.mark.parametrize("robot", ["intentional", "traditional"])
def test_a_pair_with_a_failure_counts_apart(robot: str, outcome: Outcome) -> None:
    """What a trial had done until its robot was lost says nothing of what it would have needed."""
    ended = _pairs("2", 3, 5)
    failed = [
        a_record(
            f"{kind} failed",
            pair="2 failed",
            scenario="2",
            robot=kind,
            action_count=1000,
            correct=kind != robot,
            outcome=outcome if kind == robot else "achieved",
        )
        for kind in ("intentional", "traditional")
    ]
    summary: Any = summary_of([*ended, *failed])
    without: Any = summary_of(ended)
    group, same = summary["scenarios"]["2"], without["scenarios"]["2"]
    assert (group["pairs"], group["failed_pairs"]) == (3, 1)
    assert (same["pairs"], same["failed_pairs"]) == (3, 0)
    assert group | {"failed_pairs": 0} == same
    assert _shown(summary)["2"]["pairs"] == ("3", "1 lost")


def test_a_last_row_is_about_all_scenarios() -> None:
    rows = _shown(summary_of([*_pairs("2", 1, 5), *_pairs("random", 2, 10)]))
    assert {name: cells["pairs"][0] for name, cells in rows.items()} == {
        "2": "1",
        "random": "2",
        "all": "3",
    }


def test_how_far_from_the_optimum_is_told_of_each_robot() -> None:
    records = _pairs("2", 2, 4)
    for record in records:
        record.minimal_units, record.execution_units = 10, 15
        record.achieved = record.trial != "traditional 2 0"
    assert optima(summary_of(records)) == [
        ("2", "intentional", "2", "1.50", "4.00"),
        ("2", "traditional", "1", "1.50", "11.00"),
    ]


def test_one_robot_alone_is_not_compared() -> None:
    assert groups_of(summary_of([a_record("a")])) == {}
    assert groups_of(summary_of([])) == {}
