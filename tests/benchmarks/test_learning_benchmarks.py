"""The benchmarks of what learners play, in their small size."""

from itertools import product

import pytest

from asp.language import Literal
from benchmarks import adversaries, adversary_steps, batches, environments
from benchmarks.sheets import DisagreementError


def test_games_of_each_number_are_played_at_once() -> None:
    (sheet,) = batches.main("small")
    assert [row["games"] for row in sheet.rows] == [*batches.GAMES]
    for row in sheet.rows:
        assert row["states"] == 192
        assert all(float(str(row[name])) > 0 for name in ("first", "batch", "single"))


def test_a_robot_of_which_all_is_remembered_is_asked_less() -> None:
    (sheet,) = adversary_steps.main("small")
    games = {(row["robot"], row["starts"], row["budget"]) for row in sheet.rows}
    assert len(games) == len(adversary_steps.ROBOTS) * len(adversary_steps.GAMES)
    one = [row for row in sheet.rows if row["starts"] == "one"]
    assert all(0 < float(str(row["asked"])) < 1 for row in one)
    assert all(float(str(row["remembered"])) > 0 for row in sheet.rows)


def test_no_adversary_costs_more_than_the_optimal_one() -> None:
    (sheet,) = adversaries.main("small")
    told = [(row["robot"], row["strategy"]) for row in sheet.rows]
    assert told == [*product(adversaries.ROBOTS, adversaries.STRATEGIES)]
    assert all(float(str(row["units"])) > 0 for row in sheet.rows)


def test_a_strategy_that_costs_more_than_the_optimal_one_is_refused() -> None:
    start = (Literal.parse("loc(book1,kitchen)"),)
    adversaries.check_bound("robot", {"optimal": {start: 7}, "greedy": {start: 7}})
    with pytest.raises(DisagreementError, match="greedy"):
        adversaries.check_bound("robot", {"optimal": {start: 7}, "greedy": {start: 8}})


def test_raw_environments_are_played_side_by_side() -> None:
    (sheet,) = environments.main("small")
    assert [row["environment"] for row in sheet.rows][:2] == ["office", "empty"]
    assert all(float(str(row["per_s"])) > 0 for row in sheet.rows)
    assert sheet.rows[0]["share"] == 1.0
