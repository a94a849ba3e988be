"""The judge's search has a budget of states, and what it does not find is said and not counted."""

import json
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from asp import parse_description
from testbed.config import load_config
from testbed.experiment.judge import Judge
from testbed.experiment.runner import play_missing
from testbed.report import write_report
from testbed.search import Goal, Problem
from testbed.world import world_of

Run = Callable[..., tuple[list[dict[str, Any]], dict[str, Any], str]]

LAMPS = """
sorts
  lamp = {l1, l2, l3, l4, l5, l6, l7, l8}.
  robot = {hand}.
fluents
  inertial lit(lamp).
  inertial broken(lamp).
actions
  agent press(robot, lamp).
  exogenous blow(lamp).
laws
  press(R, L) causes lit(L).
  blow(L) causes broken(L).
  -lit(L) if broken(L).
  impossible press(R, L) if lit(L).
sees
  R sees lit(L) if robot(R).
  R sees broken(L) if robot(R).
"""
"""Eight lamps to be lit one by one: 256 states, and a plan of `n` actions for `n` of them."""


@pytest.fixture
def run(tmp_path: Path) -> Run:
    """Plays the lamps, the first `wanted` of which are to be lit, with what is given besides."""
    (tmp_path / "lamps.al").write_text(LAMPS)

    def play(wanted: int, *given: str) -> tuple[list[dict[str, Any]], dict[str, Any], str]:
        goal = ", ".join(f'"lit(l{number})"' for number in range(1, wanted + 1))
        file = tmp_path / "lamps.yaml"
        file.write_text(f"name: lamps\ndomain: lamps.al\ngoal: [{goal}]\ninitial: []\n")
        config = load_config(str(file), ["link=inprocess", "script=[]", *given])
        folder = tmp_path / "-".join(["run", *given])
        play_missing(config, folder, 1, lambda _: None)
        write_report(folder, config)
        lines = (folder / "trials.jsonl").read_text(encoding="utf-8").splitlines()
        summary = json.loads((folder / "summary.json").read_text(encoding="utf-8"))
        page = (folder / "report.html").read_text(encoding="utf-8")
        return [json.loads(line) for line in lines], summary, page

    return play


def test_within_the_budget_the_least_is_known(run: Run) -> None:
    trials, summary, _ = run(5, "limits.judge_states=256")
    for trial in trials:
        assert (trial["minimal_actions"], trial["minimal_reason"]) == (5, None)
        assert trial["correct"] is True
    assert set(summary["levels"]["coarse"]["undecided"].values()) == {0}


def test_beyond_the_budget_nothing_is_counted_and_all_is_said(run: Run) -> None:
    trials, summary, page = run(5, "limits.judge_states=20")
    assert {trial["robot"] for trial in trials} == {"intentional", "traditional"}
    for trial in trials:
        assert trial["outcome"] == "achieved"
        assert (trial["minimal_actions"], trial["minimal_units"]) == (None, None)
        assert (trial["minimal_reason"], trial["correct"]) == ("budget", None)
    own = summary["levels"]["coarse"]
    assert own["pairs"] == 1
    assert own["unsolvable"] == 0
    assert own["accuracy"] == {"intentional": None, "traditional": None}
    assert own["undecided"] == {"intentional": 1, "traditional": 1}
    assert "limits.judge_states" in page


def test_where_the_fewest_actions_decide_nothing_they_need_not_be_known(run: Run) -> None:
    script = "script=[{step: 2, action: blow(l8)}]"
    trials, summary, _ = run(5, "limits.judge_states=20", script)
    assert [trial["correct"] for trial in trials] == [True, True]
    assert summary["levels"]["coarse"]["accuracy"]["intentional"] == 1.0


def test_no_plan_is_another_reason_than_the_budget(run: Run) -> None:
    broken = 'initial=["broken(l1)"]'
    trials, summary, _ = run(1, "limits.judge_states=256", broken)
    for trial in trials:
        assert (trial["minimal_reason"], trial["in_reach"]) == ("no plan", False)
        assert trial["correct"] is False
    assert summary["levels"]["coarse"]["unsolvable"] == 1
    trials, summary, _ = run(1, "limits.judge_states=20", broken)
    for trial in trials:
        assert (trial["minimal_reason"], trial["in_reach"]) == ("budget", None)
    assert summary["levels"]["coarse"]["unsolvable"] == 0


def test_whether_the_goal_is_in_reach_takes_one_search_and_no_units() -> None:
    world = world_of(parse_description(LAMPS))
    dark, lit = world.state(()), world.state([f"lit(l{number})" for number in range(1, 9)])
    asked: list[tuple[int, Goal]] = []

    def problem(state: int, goal: Goal) -> Problem:
        asked.append((state, goal))
        return world, state, goal

    judge = Judge(problem, {})
    # Out of reach, reached, and farther than two states can show.
    questions = [(lit, ("-lit(l1)",)), (lit, ("lit(l1)",)), (dark, ("lit(l1)", "lit(l2)"))]
    for _ in range(2):
        assert [judge.in_reach(*question, 2) for question in questions] == [False, True, None]
        reasons = [judge.minimal(*questions[number], 2).reason for number in (0, 2)]
        assert reasons == ["no plan", "budget"]
    assert asked == questions
