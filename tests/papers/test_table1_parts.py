"""The table of a part of the random pairs, worked out by hand."""

import pytest

from papers.table1.parts import Part, part_of
from testbed.studies.table1.measures import Row
from testbed.studies.table1.published import MEASURES
from tests.studies.table1.made import a_pair, a_side, analysed

PAIRS = [
    a_pair("3", a_side(actions=2), a_side(actions=4), state="s1"),
    a_pair("3", a_side(actions=2), a_side(correct=False, actions=1), state="s2"),
    a_pair("1", state="s3"),
    a_pair("6", state="s4"),
]


def _rows(part: Part) -> dict[str, Row]:
    return {row.name: row for row in part.table.rows}


def test_accuracies_and_ratios_are_means() -> None:
    row = _rows(part_of(PAIRS))["3"]
    ratio = row.ratios["actions"].mean
    assert row.baseline is not None
    assert ratio is not None
    assert row.baseline.value == 1 / 2
    assert ratio.value == pytest.approx((2.0 + 0.5) / 2)


def test_shares_are_those_of_scenarios_one_to_five() -> None:
    shares = {"1": 1 / 3, "2": 0.0, "3": 2 / 3, "4": 0.0, "5": 0.0}
    assert part_of(PAIRS).shares == pytest.approx(shares)


def test_rows_without_failures_leave_out_what_the_traditional_robot_got_wrong() -> None:
    rows = _rows(part_of(PAIRS))
    ratio = rows["3, no failures"].ratios["actions"].mean
    assert ratio is not None
    assert (rows["3, no failures"].pairs, ratio.value) == (1, 2.0)
    ratio = rows["all, no failures"].ratios["actions"].mean
    assert ratio is not None
    assert ratio.value == pytest.approx((2.0 + 1.0) / 2)
    assert rows["2"].baseline is None


def test_triggered_pairs_are_not_there() -> None:
    pairs = [*PAIRS, a_pair("3", intended="3")]
    assert _rows(part_of(pairs))["3"].pairs == 2


def test_where_all_are_right_the_interval_is_the_exact_one_of_as_many_states() -> None:
    pairs = [a_pair("1", state=f"s{number % 5}") for number in range(10)]
    row = _rows(part_of(pairs))["1"]
    assert row.baseline is not None
    assert row.baseline.value == row.baseline.high == 1.0
    assert row.baseline.low == pytest.approx(0.025 ** (1 / 5))


def test_a_single_state_with_both_outcomes_says_as_much_as_one_trial() -> None:
    pairs = [a_pair("1"), a_pair("1", baseline=a_side(False))]
    own = _rows(part_of(pairs))["1"].baseline
    assert own is not None
    assert own.value == 0.5
    assert own.low < 0.025 < 0.975 < own.high


def test_lost_trials_are_in_no_row() -> None:
    lost = a_pair("3", baseline=a_side(correct=False), apart="lost")
    part = part_of([*PAIRS, lost])
    assert (_rows(part)["3"].pairs, part.shares["3"]) == (2, 2 / 3)


def test_the_part_of_all_is_the_table_itself() -> None:
    table = analysed(PAIRS).tables["random"]
    rows = _rows(part_of(PAIRS))
    for row in table.rows:
        if row.name == "6":
            continue
        for measure in MEASURES:
            ours, theirs = rows[row.name].ratios[measure].mean, row.ratios[measure].mean
            assert (ours is None) == (theirs is None)
            if ours is not None and theirs is not None:
                assert ours.value == pytest.approx(theirs.value)
