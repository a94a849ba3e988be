"""Pairs and rows made by hand: what is counted where, and what comes out of it."""

import dataclasses
from itertools import count

import pytest

from papers.table1.pairs import Pair, Side, each
from testbed.analysis.comparison import DIVIDED
from testbed.analysis.comparison import MEASURES as COMPUTED
from testbed.analysis.table import table_of
from testbed.experiment.record import Activity, Attempt, Occurrence, TrialRecord
from testbed.studies import rows_of
from testbed.studies.table1.measures import Row
from testbed.studies.table1.pairs import Meeting, meeting, pairs_in, undone
from testbed.studies.table1.published import MEASURES, NO_FAILURES, PUBLISHED
from testbed.studies.table1.tables import lines
from testbed.studies.table1.tables import test_rows as effects
from testbed.world import load_world
from tests.experiment.samples import a_record
from tests.studies.table1.made import ROBOTS, a_pair, a_side, analysed

WORLD = load_world("office")
NUMBERS = count()
GOAL = ["loc(book1,library)", "loc(book2,library)"]
START = ["loc(rob1,kitchen)", "loc(book1,library)", "loc(book2,kitchen)"]


def _side(
    value: float = 1.0,
    correct: bool = True,
    event: str | None = "exo_lock(library)",
    before: tuple[str, ...] = ("a",),
) -> Side:
    return a_side(correct, event=event, before=before, **dict.fromkeys(DIVIDED, value))


def _pair(
    intended: str,
    treatment: Side,
    baseline: Side,
    happened: str | None = None,
    apart: str | None = None,
) -> Pair:
    """A pair from a state of its own."""
    state = f"state {next(NUMBERS)}"
    return a_pair(happened or intended, treatment, baseline, intended, state, apart)


def _rows(pairs: list[Pair], way: str = "triggered") -> dict[str, Row]:
    return {row.name: row for row in analysed(pairs).tables[way].rows}


def test_the_measures_are_the_published_columns() -> None:
    assert tuple(COMPUTED) == MEASURES
    assert all(set(row.ratios) == set(MEASURES) for row in PUBLISHED.values())


def test_a_row_has_the_mean_of_the_ratios_and_not_the_ratio_of_the_means() -> None:
    pairs = [_pair("3", _side(1.0), _side(4.0)), _pair("3", _side(10.0), _side(10.0))]
    ratio = _rows(pairs)["3"].ratios["actions"]
    assert ratio.mean is not None
    assert (ratio.mean.value, ratio.pairs) == (2.5, 2)


def test_a_pair_without_a_measure_has_no_ratio_and_counts_for_the_accuracy() -> None:
    pairs = [_pair("3", _side(0.0), _side(4.0)), _pair("3", _side(2.0), _side(1.0, correct=False))]
    row = _rows(pairs)["3"]
    assert (row.pairs, row.ratios["plans"].pairs) == (2, 1)
    assert row.baseline is not None
    assert row.baseline.value == 0.5


def test_what_nobody_failed_in_is_left_after_the_baselines_failures() -> None:
    pairs = [_pair("4", _side(), _side(3.0)), _pair("4", _side(), _side(0.5, correct=False))]
    rows = _rows(pairs)
    for name in ("4" + NO_FAILURES, "all" + NO_FAILURES):
        mean = rows[name].ratios["actions"].mean
        assert mean is not None
        assert (rows[name].pairs, mean.value) == (1, 3.0)
    assert rows["3" + NO_FAILURES].pairs == 0


def test_lost_trials_and_goals_that_nothing_achieves_are_counted_apart() -> None:
    pairs = [
        _pair("3", _side(), _side()),
        _pair("3", _side(correct=False), _side(), apart="lost"),
        _pair("3", _side(), _side(correct=False), apart="lost"),
        _pair("3", _side(correct=False), _side(correct=False), apart="unsolvable"),
    ]
    row = _rows(pairs)["3"]
    assert (row.pairs, row.left_out) == (1, {"failed": 2, "deadline": 0, "unsolvable": 1})
    assert row.treatment is not None
    assert row.treatment.value == 1.0


def test_what_did_not_come_to_its_scenario_is_in_no_row() -> None:
    quiet = _side(event=None)
    pairs = [
        _pair("1", quiet, quiet),
        _pair("1", quiet, quiet, happened="nothing to do", apart="nothing to do"),
        _pair("2", quiet, quiet, happened="1", apart="no event"),
        _pair("2", _side(), _side()),
        _pair("random", _side(), _side(), happened="6"),
        _pair("random", _side(), _side(), happened="unclassified"),
    ]
    analysis = analysed(pairs)
    triggered, drawn = _rows(pairs), _rows(pairs, "random")
    assert [triggered[name].pairs for name in ("1", "2", "all")] == [1, 1, 2]
    assert analysis.tables["triggered"].apart == {"no event": 1, "nothing to do": 1}
    assert [drawn[name].pairs for name in ("6", "all")] == [1, 0]
    assert analysis.tables["random"].apart == {"unclassified": 1}
    assert analysis.became["2"] == {"1": 1, "2": 1}


def test_in_the_row_of_all_each_scenario_weighs_as_if_played_equally_often() -> None:
    pairs = [_pair("2", _side(), _side(9.0))]
    pairs += [_pair("3", _side(), _side(1.0)) for _ in range(4)]
    mean = _rows(pairs)["all"].ratios["actions"].mean
    assert mean is not None
    assert mean.value == pytest.approx((4 * 9.0 + 4 * 1.0) / 8)


@pytest.mark.parametrize(("few", "many"), [(3, 4), (2, 5), (6, 7), (40, 41)])
def test_scenarios_weigh_alike_where_one_number_is_no_multiple_of_the_other(
    few: int, many: int
) -> None:
    """Half of the row of all is scenario 2, however many of its pairs are on record."""
    pairs = [_pair("2", _side(), _side(9.0, correct=False)) for _ in range(few)]
    pairs += [_pair("3", _side(), _side(1.0)) for _ in range(many)]
    row = _rows(pairs)["all"]
    ratio = row.ratios["actions"]
    assert ratio.mean is not None
    assert ratio.median is not None
    assert row.baseline is not None
    assert row.accuracy is not None
    assert ratio.mean.value == pytest.approx(5.0)
    assert ratio.median.value == pytest.approx(5.0)
    assert row.baseline.value == pytest.approx(0.5)
    assert row.accuracy.effect == pytest.approx(0.5)


def test_in_the_tests_of_all_scenarios_of_three_and_of_four_repeats_weigh_alike() -> None:
    """From each state three pairs of 2, and four of 3 that say the opposite."""
    pairs = []
    for _ in range(8):
        own = [_pair("2", _side(1.0), _side(2.0)) for _ in range(3)]
        own += [_pair("3", _side(2.0), _side(1.0)) for _ in range(4)]
        pairs += [dataclasses.replace(pair, state=own[0].state) for pair in own]
    test = _rows(pairs)["all"].ratios["actions"].test
    assert test is not None
    assert (test.p, test.effect) == (1.0, 0.0)


def test_pairs_from_one_state_are_one_witness() -> None:
    pairs = [_pair("3", _side(1.0), _side(2.0 + n)) for n in range(8)]
    again = [dataclasses.replace(pair) for pair in pairs]
    alone, both = (_rows(own)["3"] for own in (pairs, [*pairs, *again]))
    assert (alone.pairs, both.pairs) == (8, 16)
    assert both.ratios == {
        name: dataclasses.replace(ratio, pairs=16) for name, ratio in alone.ratios.items()
    }
    assert (both.treatment, both.baseline) == (alone.treatment, alone.baseline)


def test_in_the_tests_of_all_a_pair_weighs_as_in_its_means() -> None:
    """From each state a pair of 2, which counts three times, and three of 3 the other way round."""
    pairs = []
    for _ in range(8):
        once = _pair("2", _side(1.0), _side(1.5))
        often = [_pair("3", _side(1.5), _side(1.0)) for _ in range(3)]
        pairs += [once, *(dataclasses.replace(pair, state=once.state) for pair in often)]
    test = _rows(pairs)["all"].ratios["actions"].test
    assert test is not None
    assert (test.p, test.effect) == (1.0, 0.0)


def test_the_corrected_p_values_are_those_of_the_whole_table() -> None:
    few = [_pair("3", _side(1.0), _side(2.0 + n)) for n in range(8)]
    alone = _rows(few)["3"].ratios["actions"].test
    assert alone is not None
    assert alone.holm is not None
    assert (alone.p, alone.effect) == (pytest.approx(2 / 2**8), 1.0)
    assert alone.holm == pytest.approx(min(1.0, alone.p * 5 * 4))


def test_the_advantage_is_how_much_more_often_the_intentional_robot_is_right() -> None:
    pairs = [_pair("4", _side(), _side(correct=n >= 30)) for n in range(100)]
    row = _rows(pairs)["4"]
    assert row.advantage is not None
    assert row.accuracy is not None
    assert (row.advantage.value, row.accuracy.effect) == (pytest.approx(0.3), pytest.approx(0.3))
    assert row.advantage.low == pytest.approx(0.21, abs=0.03)
    assert row.advantage.high == pytest.approx(0.39, abs=0.03)


def test_a_published_value_outside_of_our_interval_is_marked() -> None:
    pairs = [_pair("1", _side(1.0, event=None), _side(1.0, event=None)) for _ in range(30)]
    table = analysed(pairs).tables["triggered"]
    cells = {row[0].strip(): row for row in list(rows_of(lines(table)))[:3]}
    assert cells["1"][3] == "1.00 [1.00, 1.00]"
    assert cells["published"][2:] == ("0.81 *", "1.00", "0.45 *", "1.00", "1.00", "100%", "100%")
    assert next(effects(table)) == ("1", *["-"] * 6)


@pytest.mark.parametrize(
    ("treatment", "baseline", "met"),
    [
        ((None, ("a", "b")), (None, ("a", "b")), "nothing"),
        (("e", ("a", "b")), ("e", ("a", "b")), "same"),
        (("e", ("a", "b")), ("e", ("c", "b")), "same later"),
        (("e", ("a", "b")), ("e", ("a", "c")), "other"),
        (("e", ("a", "b")), ("f", ("a", "c")), "other"),
        (("e", ("a", "b")), ("f", ("a", "b")), "other at once"),
        (("e", ("a", "b")), (None, ("a", "c", "d")), "other"),
        (("e", ("a", "b")), (None, ("a", "b", "d")), "other at once"),
        ((None, ("a",)), ("e", ("a", "b")), "other"),
    ],
)
def test_whether_both_met_the_same(
    treatment: tuple[str | None, tuple[str, ...]],
    baseline: tuple[str | None, tuple[str, ...]],
    met: Meeting,
) -> None:
    assert meeting(*treatment, *baseline) == met


def _record(robot: str, **values: object) -> TrialRecord:
    given: dict[str, object] = {"pair": "p", "robot": robot, "initial": START, "goal": GOAL}
    return a_record(robot, **given | {"minimal_actions": 1, "steps": 4} | values)


def test_pairs_are_joined_in_any_order_and_others_are_passed_over() -> None:
    mind = _record("intentional", activities=[Activity(1, 1, ["move(rob1,library)"])])
    mind.actions = [Attempt(2, "move(rob1,library)", True)]
    base, third = _record("traditional"), _record("intentional-checking")
    for records in ([mind, third, base], [base, mind]):
        (pair,) = each(pairs_in(table_of(records), WORLD, ROBOTS, ()))
        trials = (pair.baseline.trial, pair.treatment.trial)
        assert (pair.happened, trials) == ("1", ROBOTS)
    assert len(pairs_in(table_of([mind, third]), WORLD, ROBOTS, ())) == 0


@pytest.mark.parametrize(
    ("event", "action", "taken"),
    [
        ("exo_move(book1,office1)", "move(rob1,office2)", True),
        ("exo_move(book2,office1)", "move(rob1,office2)", False),
        ("exo_lock(library)", "move(rob1,office2)", False),
        ("exo_move(book1,office1)", "pickup(rob1,book2)", True),
    ],
)
def test_an_event_undoes_what_would_else_be_true(event: str, action: str, taken: bool) -> None:
    record = _record("intentional", actions=[Attempt(2, action, True)])
    happened = Occurrence(2, event, False)
    record.exogenous = [happened]
    assert undone(record, happened, WORLD) is taken


def test_what_the_robot_itself_undoes_is_not_undone_by_the_event() -> None:
    held = ["loc(rob1,library)", "in_hand(rob1,book1)", "loc(book1,library)", "loc(book2,kitchen)"]
    record = _record("intentional", initial=held)
    record.actions = [Attempt(2, "move(rob1,kitchen)", True)]
    happened = Occurrence(2, "exo_move(book2,office1)", False)
    record.exogenous = [happened]
    assert undone(record, happened, WORLD) is False
