"""Planning, diagnosis and both, from pairs made by hand; a wall clock changes none of it."""

from dataclasses import replace

import pytest

from testbed.experiment.record import TrialRecord
from testbed.studies.table1.measures import Analysis, Row
from testbed.studies.table1.tables import times_rows
from tests.experiment.samples import a_record, summary_of
from tests.studies.table1.made import a_pair, a_side, analysed


def _analysis() -> Analysis:
    """Two pairs: TP plans for 1 and 4 seconds and explains for 9 and 6, ATI 2, 2, 1 and 3."""
    own = [(2.0, 1.0, 1.0, 9.0), (2.0, 3.0, 4.0, 6.0)]
    pairs = [
        a_pair(
            "2",
            a_side(planning_time=mp, diagnosis_time=md, reasoning_time=mp + md),
            a_side(planning_time=bp, diagnosis_time=bd, reasoning_time=bp + bd),
            state=f"state {number}",
        )
        for number, (mp, md, bp, bd) in enumerate(own)
    ]
    return analysed(pairs)


def _row(analysis: Analysis) -> Row:
    return next(row for row in analysis.tables["random"].rows if row.name == "2")


def test_each_time_has_both_robots_seconds_the_mean_of_ratios_and_the_ratio_of_sums() -> None:
    found = _row(_analysis()).times
    expected = {
        "planning_time": (2.5, 2.0, (1 / 2 + 4 / 2) / 2, 5 / 4),
        "diagnosis_time": (7.5, 2.0, (9 / 1 + 6 / 3) / 2, 15 / 4),
        "reasoning_time": (10.0, 4.0, (10 / 3 + 10 / 5) / 2, 20 / 8),
    }
    for name, (base, mind, mean, of_sums) in expected.items():
        own = found[name]
        assert own.ratio.mean is not None
        measured = (own.baseline, own.treatment, own.ratio.mean.value, own.ratio.of_sums)
        assert measured == pytest.approx((base, mind, mean, of_sums))
        assert own.ratio.test is None, (
            "they are no tests of the table, whose correction is over all"
        )


def test_the_published_column_stands_beside_the_readings_that_it_can_have() -> None:
    table = _analysis().tables["random"]
    cells = [row for row in times_rows(table) if row[0] == "2"]
    assert [row[-1].removesuffix(" *") for row in cells] == ["1.08", "", "1.08"]


def test_without_published_figures_the_column_is_empty() -> None:
    table = _analysis().tables["random"]
    cells = [row for row in times_rows(replace(table, published={})) if row[0] == "2"]
    assert [row[-1] for row in cells] == ["", "", ""]


def _trial(robot: str, cpu: float, wall: float) -> TrialRecord:
    return a_record(
        robot,
        robot=robot,
        pair="p",
        planning_cpu_s=cpu,
        planning_time_s=wall,
        diagnosis_cpu_s=3 * cpu,
        diagnosis_time_s=wall,
        execution_units=1,
    )


@pytest.mark.parametrize("load", [1.0, 50.0])
def test_ratios_come_from_process_time(load: float) -> None:
    records = [_trial("traditional", 1.0, 1.0), _trial("intentional", 4.0, 4.0 * load)]
    times = summary_of(records)["scenarios"]["1"]["times"]
    names = ("planning_time", "diagnosis_time", "reasoning_time")
    assert times == {name: {"ratio": 0.25, "of_sums": 0.25} for name in names}
