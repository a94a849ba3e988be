"""The columns of the levels and what is compared in them, against cases reckoned by hand."""

from typing import Any

import pytest

from testbed.experiment.record import TrialRecord
from testbed.studies.levels.published import NO_ZOOM, PAPER, PARTS, ZOOM
from tests.experiment.samples import a_level_record
from tests.studies.levels.found import columns


def _summary(*records: TrialRecord) -> Any:
    return columns(records)


def _columns(*records: TrialRecord) -> Any:
    return _summary(*records)["L3"]


def test_the_columns_are_means_deviations_and_medians_of_a_trials_reasoning() -> None:
    records = [
        a_level_record("a", ZOOM),
        a_level_record("b", ZOOM, fine=0.4, planning=0.5),
        a_level_record("c", ZOOM, fine=0.9),
    ]
    columns = _columns(*records)
    zoom = columns["reasoning"][ZOOM]
    # 0.3, 0.5 and 1.0 s.
    assert zoom["fine"] == {
        "mean": pytest.approx(0.6),
        "sd": pytest.approx(0.13**0.5),
        "median": pytest.approx(0.5),
    }
    assert zoom["coarse"]["median"] == pytest.approx(0.7)
    assert zoom["total"]["mean"] == pytest.approx(0.6 + 2.3 / 3)
    assert zoom["refined_plan"]["mean"] == pytest.approx(0.25)
    assert (zoom["trials"], zoom["achieved"], zoom["completed"]) == (3, 3, 1.0)
    assert columns["zoom_ratios"] == dict.fromkeys(PARTS)
    assert columns["compared"]["pairs"] == 0


def test_ratios_are_of_pairs_in_which_both_robots_achieved_the_goal() -> None:
    columns = _columns(
        a_level_record("a", ZOOM, fine=0.2),
        a_level_record("a", NO_ZOOM, fine=0.6),
        a_level_record("b", ZOOM, fine=0.1),
        a_level_record("b", NO_ZOOM, fine=0.9, achieved=False),
        a_level_record("c", NO_ZOOM, fine=5.0),
    )
    assert columns["zoom_ratios"]["refined_plan"] == pytest.approx(3.0)
    assert columns["zoom_ratios"]["fine"] == pytest.approx(0.7 / 0.3)
    assert columns["zoom_ratios"]["coarse"] == pytest.approx(1.0)
    assert columns["reasoning"][NO_ZOOM]["completed"] == pytest.approx(2 / 3)
    assert columns["compared"]["pairs"] == 2
    assert columns["compared"]["ratios"]["fine"]["pairs"] == 1


def _ratios(*slower: float) -> list[TrialRecord]:
    """Pairs in which a refined plan takes so many times as long without zooming."""
    return [
        record
        for number, times in enumerate(slower)
        for record in (
            a_level_record(f"p{number}", ZOOM, fine=0.2),
            a_level_record(f"p{number}", NO_ZOOM, fine=0.2 * times),
        )
    ]


def test_a_ratio_has_the_mean_of_the_ratios_and_their_median_with_intervals() -> None:
    compared = _columns(*_ratios(1.0, 2.0, 9.0))["compared"]
    ratio = compared["ratios"]["refined_plan"]
    assert ratio["pairs"] == 3
    assert ratio["mean"]["value"] == pytest.approx(4.0)
    assert ratio["median"]["value"] == pytest.approx(2.0)
    # Three values alike come in one resample of 27, which is more than 2.5%.
    for estimate in (ratio["mean"], ratio["median"]):
        assert (estimate["low"], estimate["high"]) == (pytest.approx(1.0), pytest.approx(9.0))


def test_the_tests_are_wilcoxons_with_holms_correction_over_all_levels() -> None:
    slower = _ratios(*(2.0 + n for n in range(8)))
    others = _ratios(*(2.0 + n for n in range(8)))
    for record in others:
        record.level, record.trial, record.pair = "L4", f"x{record.trial}", f"x{record.pair}"
    alone, both = _summary(*slower), _summary(*slower, *others)
    for levels, tests in ((alone, 3), (both, 6)):  # of total, fine, refined plan; coarse is alike
        test = levels["L3"]["compared"]["ratios"]["fine"]["test"]
        assert test["p"] == pytest.approx(2 / 2**8)
        assert test["effect"] == 1.0
        assert test["holm"] == pytest.approx(tests * 2 / 2**8)
    assert alone["L3"]["compared"]["ratios"]["coarse"]["test"] is None


def test_the_trials_that_only_one_achieves_are_tested_as_mcnemar_does() -> None:
    records = [
        record
        for number in range(10)
        for record in (
            a_level_record(f"p{number}", ZOOM),
            a_level_record(f"p{number}", NO_ZOOM, achieved=number < 4),
        )
    ]
    compared = _columns(*records)["compared"]
    for key in ("completed_test", "correct_test"):
        assert compared[key]["p"] == pytest.approx(2 / 2**6)  # six of six on one side
        assert compared[key]["effect"] == pytest.approx(0.6)
        # The least p-value of two tests, those of the times being without a difference.
        assert compared[key]["holm"] == pytest.approx(2 * 2 / 2**6)
    assert compared["completed"][NO_ZOOM]["value"] == pytest.approx(0.4)
    assert compared["completed"][ZOOM]["low"] == pytest.approx(0.025**0.1)  # Clopper and Pearson


def test_a_trial_without_its_robot_is_not_completed_and_has_no_times() -> None:
    records = [
        *_ratios(2.0),
        a_level_record("q", ZOOM, achieved=False, outcome="robot_lost", cause="robot"),
    ]
    columns = _columns(*records)
    assert columns["reasoning"][ZOOM]["trials"] == 2
    assert columns["reasoning"][ZOOM]["completed"] == 0.5
    assert columns["reasoning"][ZOOM]["refined_plans"]["mean"] == 2.0
    assert columns["reasoning"][ZOOM]["fine"]["sd"] == 0.0


def test_growth_is_the_mean_at_a_level_divided_by_that_at_the_first() -> None:
    first = [
        a_level_record("a", ZOOM, level="L1", fine=0.1, infer=0.0),
        a_level_record("b", ZOOM, level="L1", fine=0.3, infer=0.0),
    ]
    later = [
        a_level_record("c", ZOOM, fine=0.6, infer=0.0),
        a_level_record("d", ZOOM, fine=0.6, infer=0.0),
        a_level_record("e", ZOOM, fine=1.8, infer=0.0),
        a_level_record("e", NO_ZOOM, fine=1.8, infer=0.0),
    ]
    levels = _summary(*first, *later)
    assert levels["L1"]["compared"]["growth"] == {}
    growth = levels["L3"]["compared"]["growth"]
    assert set(growth) == {ZOOM}
    assert growth[ZOOM]["fine"]["mean"]["value"] == pytest.approx(5.0)
    assert growth[ZOOM]["fine"]["median"]["value"] == pytest.approx(3.0)
    coarse = growth[ZOOM]["coarse"]["mean"]
    assert [coarse[key] for key in ("value", "low", "high")] == [pytest.approx(1.0)] * 3
    low, high = (growth[ZOOM]["fine"]["mean"][key] for key in ("low", "high"))
    assert 2.0 <= low < 5.0 < high <= 18.0


def test_published_values_stand_beside_ours_where_there_are() -> None:
    records = [
        a_level_record(f"{level}{number}", robot, level=level)
        for level in ("L1", "L3", "mine")
        for number in range(20)
        for robot in (ZOOM, NO_ZOOM)
    ]
    summary = columns(records, PAPER)
    published = summary["L3"]["published"]
    # All of 20 alike: the exact interval ends at 0.025 ** (1 / 20) = 0.83.
    assert published["completed"] == {
        ZOOM: {"published": 1.0, "inside": True},
        NO_ZOOM: {"published": 0.65, "inside": False},
    }
    assert published["ratios"]["coarse"] == {"published": 1.0, "inside": True}
    assert published["ratios"]["total"] == {"published": 20.07, "inside": False}
    assert published["growth"][ZOOM]["coarse"]["published"] == pytest.approx(7.40 / 4.67)
    assert published["seconds"][NO_ZOOM]["refined_plan"] == {"mean": 45.98, "sd": 43.05}
    assert "growth" not in summary["L1"]["published"]
    assert "published" not in summary["mine"]
    assert not any("published" in level for level in columns(records).values())
