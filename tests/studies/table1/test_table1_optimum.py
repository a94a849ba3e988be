"""How far both robots are from the optimum, from pairs made by hand."""

from typing import Any

from papers.table1.pairs import Pair, Side
from testbed.studies.table1.tables import optimum_rows
from tests.studies.table1.made import ROBOTS, a_pair, a_side, analysed


def _side(actions: float, units: float, achieved: bool = True) -> Side:
    return a_side(achieved, actions=actions, execution_units=units)


def _pair(scenario: str, treatment: Side, baseline: Side, happened: str = "") -> Pair:
    state = f"state of {scenario}"
    return a_pair(happened or scenario, treatment, baseline, scenario, state)


def _optimum(trials: int, units: float | None, actions: float | None) -> dict[str, Any]:
    return {"trials": trials, "execution_units": units, "actions": actions}


GAVE_UP = _side(99.0, 99.0, achieved=False)


def _optima(*pairs: Pair, actions: int = 4) -> dict[str, dict[str, Any]]:
    least = {"actions": actions, "execution_units": 10}
    table = analysed(pairs, least).tables["triggered"]
    return {row.name: dict(row.optimum) for row in table.rows}


def test_it_is_the_mean_of_the_quotients_over_trials_that_achieved_their_goal() -> None:
    pairs = [_pair("3", _side(4.0, 10.0), GAVE_UP), _pair("3", _side(8.0, 30.0), _side(6.0, 5.0))]
    found = _optima(*pairs)["3"]
    assert found == {"intentional": _optimum(2, 2.0, 1.5), "traditional": _optimum(1, 0.5, 1.5)}


def test_without_a_trial_that_achieved_its_goal_there_is_none() -> None:
    found = _optima(_pair("3", _side(4.0, 10.0), GAVE_UP))["3"]
    assert found["traditional"] == _optimum(0, None, None)


def test_a_goal_that_needs_nothing_has_no_quotient() -> None:
    found = _optima(_pair("3", _side(4.0, 10.0), GAVE_UP), actions=0)["3"]
    assert found["intentional"] == _optimum(0, None, None)


def test_in_the_row_of_all_scenarios_weigh_the_same() -> None:
    pairs = [_pair("3", _side(4.0, 10.0), GAVE_UP) for _ in range(4)]
    found = _optima(*pairs, _pair("4", _side(8.0, 40.0), GAVE_UP))["all"]["intentional"]
    assert found == _optimum(5, (4 * 1.0 + 4 * 4.0) / 8, (4 * 1.0 + 4 * 2.0) / 8)


def test_both_tables_have_their_rows() -> None:
    pairs = [
        _pair("3", _side(4.0, 10.0), GAVE_UP),
        _pair("random", _side(5.0, 25.0), GAVE_UP, happened="4"),
    ]
    tables = analysed(pairs, {"actions": 4, "execution_units": 10}).tables
    rows = {way: list(optimum_rows(table, ROBOTS)) for way, table in tables.items()}
    assert ("3", "0", "-", "-", "1", "1.00", "1.00") in rows["triggered"]
    assert ("4", "0", "-", "-", "1", "2.50", "1.25") in rows["random"]
    assert "3" not in [row[0] for row in rows["random"]]
