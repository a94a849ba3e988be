"""The columns of the levels and their table, from records made by hand."""

from typing import Any

import pytest

from testbed.experiment.levels.published import NO_ZOOM, PARTS, PUBLISHED, RATIOS, ZOOM
from testbed.experiment.levels.table import LEVEL_COLUMNS, level_rows
from testbed.experiment.record import FineCounts, TrialRecord
from testbed.experiment.summary import summarise
from testbed.experiment.tables import headings, rows_of
from tests.experiment.samples import a_record


def _level(
    trial: str, robot: str, achieved: bool = True, in_reach: bool | None = None, **times: float
) -> TrialRecord:
    counts = FineCounts(
        plans=2, planning_time_s=times.get("fine", 0.2), infer_time_s=times.get("infer", 0.1)
    )
    return a_record(
        f"{trial} {robot}",
        pair=trial,
        robot=robot,
        scenario="levels",
        level="L3",
        fine=counts,
        achieved=achieved,
        outcome="achieved" if achieved else "gave_up",
        in_reach=in_reach,
        planning_time_s=times.get("planning", 0.3),
        diagnosis_time_s=times.get("diagnosis", 0.4),
    )


def _columns(*records: TrialRecord) -> Any:
    summary: Any = summarise(records)
    return summary["levels"]["L3"]


def test_the_columns_are_means_and_deviations_of_a_trials_reasoning() -> None:
    columns = _columns(_level("a", ZOOM), _level("b", ZOOM, fine=0.4, planning=0.5))
    zoom = columns["reasoning"][ZOOM]
    assert zoom["fine"] == {"mean": pytest.approx(0.4), "sd": pytest.approx(0.02**0.5)}
    assert zoom["coarse"]["mean"] == pytest.approx(0.8)
    assert zoom["total"]["mean"] == pytest.approx(1.2)
    assert zoom["refined_plan"]["mean"] == pytest.approx(0.15)
    assert (zoom["trials"], zoom["achieved"], zoom["completed"]) == (2, 2, 1.0)
    assert columns["zoom_ratios"] == dict.fromkeys(PARTS)


def test_ratios_are_of_pairs_in_which_both_robots_achieved_the_goal() -> None:
    columns = _columns(
        _level("a", ZOOM, fine=0.2),
        _level("a", NO_ZOOM, fine=0.6),
        _level("b", ZOOM, fine=0.1),
        _level("b", NO_ZOOM, fine=0.9, achieved=False),
        _level("c", NO_ZOOM, fine=5.0),
    )
    assert columns["zoom_ratios"]["refined_plan"] == pytest.approx(3.0)
    assert columns["zoom_ratios"]["fine"] == pytest.approx(0.7 / 0.3)
    assert columns["zoom_ratios"]["coarse"] == pytest.approx(1.0)
    assert columns["reasoning"][NO_ZOOM]["completed"] == pytest.approx(2 / 3)


def test_a_goal_out_of_reach_is_counted_beside_what_was_achieved() -> None:
    records = [_level("a", ZOOM), _level("b", ZOOM, achieved=False, in_reach=False)]
    records.append(_level("c", ZOOM, achieved=False, in_reach=True))
    assert _columns(*records)["reasoning"][ZOOM]["out_of_reach"] == 1
    assert level_rows(summarise(records))[0][2] == "1/3, 1 out of reach"


def test_the_table_has_the_published_figures_beside_ours() -> None:
    rows = level_rows(summarise([_level("a", ZOOM), _level("a", NO_ZOOM)]))
    assert [row[:3] for row in rows] == [
        ("L3", "zoom", "1/1"),
        ("L3", "  published", "100 %"),
        ("L3", "no zoom", "1/1"),
        ("L3", "  published", "65 %"),
        ("L3", "no zoom / zoom", ""),
        ("L3", "  published", ""),
    ]
    assert all(len(row) == len(LEVEL_COLUMNS) for row in rows)
    assert rows[1][3:] == ("11.59 ± 3.88 s", "4.19 ± 1.48 s", "7.40 ± 2.57 s", "560.0 ± 50.0 ms")
    assert rows[0][3] == "1.00 ± 0.00 s"
    assert rows[5][3:] == ("20.07", "55.23", "1.00", "83.49")


def test_totals_of_the_published_figures_are_the_sums_of_their_parts() -> None:
    for (level, condition), figures in PUBLISHED.items():
        if figures.seconds:
            mean = {part: figures.seconds[part][0] for part in PARTS}
            # The published values are rounded to a hundredth each.
            assert mean["fine"] + mean["coarse"] == pytest.approx(mean["total"], abs=0.011), level
        else:
            assert (condition, figures.completed) == (NO_ZOOM, 0.0)
    assert set(RATIOS) == {"L1", "L2", "L3"}


def test_rows_are_by_level_and_a_run_without_levels_has_no_such_table() -> None:
    rows = rows_of([_level("a", ZOOM)])
    assert headings(rows)[0] == "level"
    assert rows[0].cells()[:2] == ("L3", ZOOM)
    coarse = [a_record("a")]
    assert headings(rows_of(coarse))[0] == "scenario"
    assert level_rows(summarise(coarse)) == []
