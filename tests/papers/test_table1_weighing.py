"""A table of pairs that weigh differently, worked out by hand."""

import pytest

from papers.table1.weighing import Weighing, weighing
from testbed.studies.table1.measures import Row
from testbed.studies.table1.published import MEASURES
from tests.studies.table1.made import a_pair, a_side, analysed

PAIRS = [
    a_pair("3", a_side(actions=2), a_side(actions=4), state="s1"),
    a_pair("3", a_side(actions=2), a_side(correct=False, actions=1), state="s2"),
    a_pair("1", state="s3"),
    a_pair("6", state="s4"),
]


def _rows(weighed: Weighing) -> dict[str, Row]:
    return {row.name: row for row in weighed.table.rows}


def test_accuracies_and_ratios_are_weighted_means() -> None:
    row = _rows(weighing(PAIRS, [1.0, 3.0, 4.0, 5.0]))["3"]
    ratio = row.ratios["actions"].mean
    assert row.baseline is not None
    assert ratio is not None
    assert row.baseline.value == pytest.approx(1 / 4)
    assert ratio.value == pytest.approx((1 * 2.0 + 3 * 0.5) / 4)


def test_shares_are_those_of_the_weights_in_scenarios_one_to_five() -> None:
    weighed = weighing(PAIRS, [1.0, 3.0, 4.0, 5.0])
    assert weighed.shares == pytest.approx({"1": 0.5, "2": 0.0, "3": 0.5, "4": 0.0, "5": 0.0})
    assert weighed.inside == pytest.approx(8.0 / 13.0)
    assert weighed.worth == pytest.approx(13.0**2 / (1 + 9 + 16 + 25))


def test_rows_without_failures_leave_out_what_the_traditional_robot_got_wrong() -> None:
    rows = _rows(weighing(PAIRS, [1.0, 3.0, 4.0, 5.0]))
    ratio = rows["3, no failures"].ratios["actions"].mean
    assert ratio is not None
    assert (rows["3, no failures"].pairs, ratio.value) == (1, 2.0)
    ratio = rows["all, no failures"].ratios["actions"].mean
    assert ratio is not None
    assert ratio.value == pytest.approx((1 * 2.0 + 4 * 1.0) / 5)
    assert rows["2"].baseline is None


def test_what_weighs_nothing_is_not_there() -> None:
    assert _rows(weighing(PAIRS, [0.0, 3.0, 4.0, 5.0]))["3"].pairs == 1


def test_where_all_are_right_the_interval_is_the_exact_one_of_as_many_states() -> None:
    pairs = [a_pair("1", state=f"s{number % 5}") for number in range(10)]
    row = _rows(weighing(pairs, [2.0] * 10))["1"]
    assert row.baseline is not None
    assert row.baseline.value == row.baseline.high == 1.0
    assert row.baseline.low == pytest.approx(0.025 ** (1 / 5))


def test_states_that_weigh_differently_are_as_few_as_weigh_alike() -> None:
    """Two states of weight 3 and 1 say as much as 16/10 of one weight, however they are split."""
    right = [a_pair("1", state=state) for state in ("s1", "s1", "s2")]
    wrong = [a_pair("1", baseline=a_side(False), state=state) for state in ("s1", "s1", "s2")]
    above, below = (_rows(weighing(own, [1.0, 2.0, 1.0]))["1"].baseline for own in (right, wrong))
    assert above is not None
    assert below is not None
    tail = 0.025 ** (1 / 1.6)
    assert [above.low, above.high] == pytest.approx([tail, 1.0])
    assert [below.low, below.high] == pytest.approx([0.0, 1 - tail])


def test_a_single_state_with_both_outcomes_says_as_much_as_one_trial() -> None:
    pairs = [a_pair("1"), a_pair("1", baseline=a_side(False))]
    own = _rows(weighing(pairs, [1.0, 1.0]))["1"].baseline
    assert own is not None
    assert own.value == 0.5
    assert own.low < 0.025 < 0.975 < own.high


def test_lost_trials_are_in_no_row() -> None:
    lost = a_pair("3", baseline=a_side(correct=False), apart="lost")
    weighed = weighing([*PAIRS, lost], [1.0, 3.0, 4.0, 5.0, 9.0])
    assert (_rows(weighed)["3"].pairs, weighed.shares["3"]) == (2, 0.5)


def test_equal_weights_give_the_table_itself() -> None:
    table = analysed(PAIRS).tables["random"]
    weighed = _rows(weighing(PAIRS, [2.0] * 4))
    for row in table.rows:
        if row.name == "6":
            continue
        for measure in MEASURES:
            ours, theirs = weighed[row.name].ratios[measure].mean, row.ratios[measure].mean
            assert (ours is None) == (theirs is None)
            if ours is not None and theirs is not None:
                assert ours.value == pytest.approx(theirs.value)
