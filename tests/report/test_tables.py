"""The table of a run, its summary and its statistics, from records made by hand."""

from collections.abc import Collection, Iterable, Mapping, Sequence
from typing import Any

import msgspec
import polars as pl
import pytest

from asp.language import Literal
from testbed.analysis.comparison import Apart
from testbed.analysis.table import table_of
from testbed.experiment.record import At, Explained, Occurrence, TrialRecord
from testbed.report.tables import COLUMNS, Row, explained, rows_of
from tests.experiment.samples import a_record, summary_of


def _rows(records: Iterable[TrialRecord], apart: Mapping[str, Apart] | None = None) -> list[Row]:
    """The rows of records, whose pairs are left out of comparisons for these reasons."""
    trials, reasons = table_of(records), apart or {}
    column = [reasons.get(pair) for pair in trials["pair"]]
    return rows_of(trials, pl.Series("apart", column, pl.String))


GAVE_UP: dict[str, Any] = {"achieved": False, "outcome": "gave_up"}


def _pair(
    number: int, traditional: dict[str, Any], intentional: dict[str, Any]
) -> list[TrialRecord]:
    """A pair from a state of its own."""
    common: dict[str, Any] = {"pair": f"pair {number}", "initial": [f"state {number}"]}
    return [
        a_record(f"t{number}", robot="traditional", **common | traditional),
        a_record(f"i{number}", robot="intentional", **common | intentional),
    ]


def _group(records: Sequence[TrialRecord], scenario: str = "1", sure: Collection[str] = ()) -> Any:
    summary: Any = summary_of(records, sure)
    return summary["scenarios"][scenario]


def test_one_trial_a_row_is_shown_as_it_was() -> None:
    record = a_record(
        plans=2,
        action_count=8,
        execution_units=80,
        planning_cpu_s=0.0123,
        explanations=[Explained(3, [At(2, "exo_lock(library)")], [])],
    )
    (row,) = _rows([record])
    assert dict(zip(COLUMNS, row.cells(), strict=True)) == {
        "scenario": "1",
        "robot": "intentional",
        "achieved": "yes",
        "plans": "2",
        "actions": "8",
        "exec. units": "80",
        "planning": "12 ms",
        "explained by": "exo_lock(library)",
    }


def test_several_trials_are_counted_and_averaged() -> None:
    explanations = [
        Explained(3, [At(2, "e")], [Literal.parse("-d")]),
        Explained(5, [At(2, "e")], []),
    ]
    rows = _rows(
        [
            a_record("a", action_count=4, explanations=explanations),
            a_record("b", action_count=7, **GAVE_UP, explanations=explanations[1:]),
            a_record("c", action_count=90, outcome="robot_lost", cause="robot", achieved=False),
            a_record("e", action_count=90, outcome="robot_lost", cause="infrastructure"),
            a_record("d", robot="traditional"),
        ]
    )
    cells = dict(zip(COLUMNS, rows[0].cells(), strict=True))
    assert (cells["achieved"], cells["actions"]) == ("1/3, 1 gave up, 1 robot lost, 1 lost", "5.5")
    assert cells["explained by"] == "e x2, exception -d x1"
    assert [row.robot for row in rows] == ["intentional", "traditional"]


def test_means_have_one_decimal_whatever_they_are() -> None:
    rows = _rows(a_record(n, action_count=100, execution_units=25 * int(n)) for n in "124")
    cells = dict(zip(COLUMNS, rows[0].cells(), strict=True))
    assert (cells["actions"], cells["exec. units"], cells["plans"]) == ("100.0", "58.3", "0.0")


def test_a_row_of_failures_alone_has_no_means() -> None:
    (row,) = _rows([a_record(outcome="error", cause="robot", achieved=False)])
    cells = dict(zip(COLUMNS, row.cells(), strict=True))
    assert (cells["achieved"], cells["plans"], cells["planning"]) == ("no, error", "-", "-")


def test_a_note_is_kept_of_trials_that_were_played_to_their_end() -> None:
    reason = "script step 50 was not reached"
    (row,) = _rows([a_record(reason=reason)])
    assert row.notes() == ("scenario 1, intentional: script step 50 was not reached",)
    lost = a_record("d", outcome="robot_lost", reason="robot is gone")
    (row,) = _rows(
        [a_record("a", reason=reason), a_record("b", reason=reason), a_record("c"), lost]
    )
    assert row.notes() == (
        "scenario 1, intentional: script step 50 was not reached in 2 of 3 trials",
    )


@pytest.mark.parametrize(
    ("achieved", "outcome", "shown"),
    [
        (True, "achieved", "yes"),
        (False, "gave_up", "no, gave up"),
        (False, "false_finish", "no, false finish"),
        (False, "step_limit", "no, step limit"),
        (True, "step_limit", "yes, step limit"),
        (False, "robot_lost", "-, 1 lost"),
    ],
)
def test_a_trial_alone_in_its_row_is_shown_with_its_outcome(
    achieved: bool, outcome: str, shown: str
) -> None:
    (row,) = _rows([a_record(achieved=achieved, outcome=outcome)])
    assert row.cells()[COLUMNS.index("achieved")] == shown


def test_outcomes_are_counted_in_the_order_in_which_they_are_declared() -> None:
    endings = ["error", "gave_up", "step_limit", "gave_up", "false_finish"]
    bad = [a_record(str(n), achieved=False, outcome=ending) for n, ending in enumerate(endings)]
    (row,) = _rows([*bad, a_record("good")])
    shown = "1/5, 1 false finish, 2 gave up, 1 step limit, 1 lost"
    assert row.cells()[COLUMNS.index("achieved")] == shown


def test_what_was_explained_is_listed_once_in_the_order_of_its_steps() -> None:
    later = Explained(9, [At(2, "e"), At(7, "d"), At(1, "z")], [Literal.parse("g")])
    record = a_record(explanations=[Explained(3, [At(2, "e"), At(1, "z")], []), later])
    assert explained(msgspec.to_builtins(record.explanations, enc_hook=str)) == [
        "exception g",
        "z",
        "e",
        "d",
    ]
    (row,) = _rows([record])
    assert row.cells()[-1] == "exception g, z, e, 1 other"


def test_pairs_that_are_not_compared_have_rows_of_their_own() -> None:
    records = [
        *_pair(1, {"scenario": "3"}, {"scenario": "3"}),
        *_pair(2, {"scenario": "3"}, {"scenario": "3"}),
        *_pair(3, {"scenario": "3"}, {"scenario": "3"}),
        *_pair(4, {"scenario": "4"}, {"scenario": "4"}),
        *_pair(5, {"scenario": "4"}, {"scenario": "4", "outcome": "error", "cause": "robot"}),
    ]
    apart: dict[str, Apart] = {
        "pair 1": Apart.WITHOUT_EVENT,
        "pair 2": Apart.NOTHING_TO_DO,
        "pair 4": Apart.NOTHING_TO_DO,
        "pair 5": "lost",
    }
    rows = _rows(records, apart)
    assert [(row.cells()[0], row.trials) for row in rows if row.robot == "intentional"] == [
        ("3", 1),
        ("3, no event", 1),
        ("4", 1),
        ("nothing to do", 2),
    ]
    assert sum(row.trials + row.lost for row in rows) == len(records)


def test_a_note_says_where_its_pairs_are() -> None:
    records = [a_record(name, reason="why", pair=name) for name in "ab"]
    rows = _rows(records, {"a": Apart.WITHOUT_EVENT, "b": Apart.NOTHING_TO_DO})
    assert [note for row in rows for note in row.notes()] == [
        "scenario 1, no event, intentional: why",
        "nothing to do, intentional: why",
    ]


def test_explanations_of_many_trials_come_by_count_then_by_name() -> None:
    told = [["b"], ["c"], ["c", "a"], ["e", "d"]]
    rows = _rows(
        a_record(str(n), explanations=[Explained(9, [At(n, name) for name in names], [])])
        for n, names in enumerate(told)
    )
    assert rows[0].cells()[-1] == "c x2, a x1, b x1, 2 others"


def test_ratios_are_means_of_the_pairs_ratios() -> None:
    records = [
        *_pair(1, {"action_count": 6, "plans": 1}, {"action_count": 3, "plans": 1}),
        *_pair(2, {"action_count": 4, "plans": 1}, {"action_count": 4, "plans": 2}),
    ]
    group = _group(records)
    assert group["pairs"] == 2
    assert group["ratios"]["actions"] == pytest.approx((2 + 1) / 2)
    assert group["ratios"]["plans"] == pytest.approx((1 + 0.5) / 2)


def test_a_pair_in_which_nothing_was_needed_has_no_ratio() -> None:
    records = [
        *_pair(1, {"action_count": 6}, {"action_count": 2}),
        *_pair(2, {"action_count": 5}, {"action_count": 0}),
    ]
    group = _group(records)
    assert group["ratios"]["actions"] == pytest.approx(3.0)
    assert group["ratios"]["plans"] is None


def test_total_time_is_planning_seconds_plus_units() -> None:
    group = _group(
        _pair(
            1,
            {"planning_cpu_s": 5.0, "execution_units": 15},
            {"planning_cpu_s": 2.0, "execution_units": 8},
        )
    )
    assert group["ratios"]["total_time"] == pytest.approx(2.0)


def test_accuracy_is_the_share_of_correct_trials_of_each_robot() -> None:
    records = [
        *_pair(1, {"correct": False}, {}),
        *_pair(2, {}, {}),
        *_pair(3, {"correct": False}, {"correct": False}),
        a_record("i4", pair="pair 4", correct=False),
        a_record("c1", pair="pair 1", robot="intentional-checking"),
    ]
    group = _group(records)
    assert group["accuracy"] == {
        "traditional": pytest.approx(1 / 3),
        "intentional": pytest.approx(2 / 3),
        "intentional-checking": 1.0,
    }
    assert (group["pairs"], group["incomplete"]) == (3, 1)


EVENT = [Occurrence(2, "exo_lock(library)", False)]
IDLE: dict[str, Any] = {"actions": [], "activities": []}


@pytest.mark.parametrize(
    ("both", "intentional", "key"),
    [
        ({"exogenous": EVENT}, {"outcome": "error"}, "failed_pairs"),
        ({"exogenous": EVENT, "minimal_actions": None}, {}, "unsolvable"),
        ({"exogenous": EVENT} | IDLE, {}, "nothing_to_do"),
        ({}, {}, "without_event"),
        ({"exogenous": EVENT}, {"exogenous": []}, "without_event"),
        # A failure says more than what did not come to pass before it.
        ({}, {"outcome": "error"}, "failed_pairs"),
    ],
)
def test_what_compares_nothing_is_counted_apart(
    both: dict[str, Any], intentional: dict[str, Any], key: str
) -> None:
    apart = _pair(1, both | {"action_count": 9}, both | {"action_count": 1} | intentional)
    counted = _pair(
        2, {"exogenous": EVENT, "action_count": 6}, {"exogenous": EVENT, "action_count": 2}
    )
    group = _group([*apart, *counted], sure={"1"})
    assert (group["pairs"], group["ratios"]["actions"]) == (1, 3.0)
    reasons = ("incomplete", "failed_pairs", "unsolvable", "nothing_to_do", "without_event")
    assert {name: group[name] for name in reasons if group[name]} == {key: 1}
    alone = _group(apart, sure={"1"})
    assert alone["accuracy"] == {"traditional": None, "intentional": None}
    assert set(alone["p_values"].values()) == {None}


def test_without_an_event_a_pair_counts_where_none_is_to_happen() -> None:
    pair = _pair(1, {}, {})
    assert _group(pair, sure={"2"})["pairs"] == 1
    assert _group(pair, sure={"1"})["pairs"] == 0


def test_one_robot_alone_is_judged_by_its_own_trials() -> None:
    records = [a_record("a", exogenous=EVENT), a_record("b"), a_record("c", outcome="error")]
    group = _group(records, sure={"1"})
    assert (group["pairs"], group["without_event"], group["failed_pairs"]) == (1, 1, 1)
    assert group["accuracy"] == {"intentional": 1.0}
    assert set(group["ratios"].values()) == {None}


def test_the_optimum_is_of_trials_that_achieved_their_goal() -> None:
    least = {"minimal_actions": 4, "minimal_units": 40}
    records = [
        *_pair(1, least | {"action_count": 8, "execution_units": 60}, least | {"action_count": 4}),
        *_pair(2, least | {"action_count": 1} | GAVE_UP, least | {"action_count": 6}),
    ]
    found = _group(records)["optimum"]
    assert found["traditional"] == {"trials": 1, "actions": 2.0, "execution_units": 1.5}
    assert found["intentional"] == {"trials": 2, "actions": 1.25, "execution_units": 0.0}
    assert _group(_pair(1, {}, {}))["optimum"]["traditional"]["actions"] is None


def test_p_values_stand_beside_holms_over_the_whole_summary() -> None:
    """Two scenarios and both together have 2 tests each: 6 in all."""
    records = [
        record
        for number in range(16)
        for record in _pair(
            number,
            {"action_count": 10 + number, "correct": False, "scenario": "ab"[number % 2]},
            {"scenario": "ab"[number % 2]},
        )
    ]
    summary: Any = summary_of(records)
    one, both = summary["scenarios"]["a"], summary["levels"]["coarse"]
    assert one["p_values"]["actions"] == pytest.approx(2 / 2**8)
    assert both["p_values"]["actions"] < 1e-3
    # The two of both together are the smallest; of four that are equal the largest counts.
    assert one["holm"]["actions"] == pytest.approx(4 * 2 / 2**8)
    assert both["holm"]["accuracy"] == pytest.approx(6 * 2 / 2**16)
    assert (one["effects"]["actions"], one["effects"]["accuracy"]) == (1.0, 1.0)
    assert one["holm"]["plans"] is one["effects"]["plans"] is None


def test_a_scenario_that_is_the_only_one_is_tested_once() -> None:
    records = [r for n in range(8) for r in _pair(n, {"action_count": 1 + n}, {})]
    summary: Any = summary_of(records)
    for group in (summary["scenarios"]["1"], summary["levels"]["coarse"]):
        assert group["holm"]["actions"] == pytest.approx(2 / 2**8)


def test_p_values_are_the_exact_ones() -> None:
    records = [
        record
        for number in range(5)
        for record in _pair(number, {"action_count": 10 + number, "correct": False}, {})
    ]
    p_values = _group(records)["p_values"]
    # Five differences of one sign: 2 of the 2^5 equally likely ways are as extreme.
    assert p_values["actions"] == pytest.approx(2 / 2**5)
    assert p_values["accuracy"] == pytest.approx(2 / 2**5)
    assert p_values["plans"] is None


def test_a_summary_tells_scenarios_and_levels_apart() -> None:
    summary: Any = summary_of([a_record("a"), a_record("b", scenario="2")])
    assert summary["trials"] == 2
    assert set(summary["scenarios"]) == {"1", "2"}
    assert summary["levels"]["coarse"]["pairs"] == 2
    assert _group([a_record("a")])["p_values"]["accuracy"] is None
