"""What other people's programs read of a run: every key of a record and of the summary."""

import json
from pathlib import Path
from typing import Any

import pytest

from testbed.config import load_config
from testbed.experiment.runner import play_missing
from testbed.report import write_report

RECORD: dict[str, tuple[type, ...]] = {
    "trial": (str,),
    "pair": (str,),
    "scenario": (str,),
    "seed": (int,),
    "robot": (str,),
    "domain": (str,),
    "level": (str,),
    "initial": (list,),
    "goal": (list,),
    "achieved": (bool,),
    "finished": (bool,),
    "correct": (bool, type(None)),
    "minimal_actions": (int, type(None)),
    "minimal_units": (int, type(None)),
    "oracle_units": (int, type(None)),
    "outcome": (str,),
    "actions": (list,),
    "exogenous": (list,),
    "explanations": (list,),
    "plans": (int,),
    "action_count": (int,),
    "execution_units": (int,),
    "planning_time_s": (float,),
    "diagnosis_time_s": (float,),
    "reasoning_time_s": (float,),
    "wall_time_s": (float,),
    "planning_cpu_s": (float,),
    "diagnosis_cpu_s": (float,),
    "preparation_cpu_s": (float,),
    "fine": (type(None),),
}
ITEMS: dict[str, dict[str, type]] = {
    "actions": {"step": int, "action": str, "happened": bool},
    "exogenous": {"step": int, "action": str, "observed": bool},
    "explanations": {"step": int, "unobserved": list, "exceptions": list},
}
OUTCOMES = {"achieved", "false_finish", "gave_up", "step_limit", "robot_lost", "error"}


@pytest.fixture(scope="module")
def run(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Two scenarios with events, explanations and a false finish, and one in error."""
    folder: Path = tmp_path_factory.mktemp("contract")
    script = "scenario_settings.1.script=[{step: 1, action: 'exo_move(book1,office1)'}]"
    config = load_config("quickstart", ["link=inprocess", "scenarios=[2,5,1]", script])
    play_missing(config, folder, 1, lambda _: None)
    write_report(folder, config)
    return folder


@pytest.fixture
def lines(run: Path) -> list[dict[str, Any]]:
    text = (run / "trials.jsonl").read_text(encoding="utf-8")
    return [json.loads(line) for line in text.splitlines()]


def test_a_line_has_every_key_with_a_value_of_its_type(lines: list[dict[str, Any]]) -> None:
    assert len(lines) == 6
    for line in lines:
        for key, kinds in RECORD.items():
            assert key in line
            assert type(line[key]) in kinds, key
        assert all(isinstance(literal, str) for literal in line["initial"] + line["goal"])
        assert line["level"] == "coarse"
        assert line["fine"] is None
        assert line["outcome"] in OUTCOMES
        assert (line["correct"] is None) == (line["cause"] in ("infrastructure", "testbed"))
    assert {line["outcome"] for line in lines} == {"achieved", "false_finish", "error"}


@pytest.mark.parametrize("key", ITEMS)
def test_the_items_of_a_line_have_their_keys(lines: list[dict[str, Any]], key: str) -> None:
    items = [item for line in lines for item in line[key]]
    assert items
    for item in items:
        assert {name: type(item.get(name)) for name in ITEMS[key]} == ITEMS[key]


def test_an_explanation_lists_events_with_step_and_action(lines: list[dict[str, Any]]) -> None:
    events = [e for line in lines for item in line["explanations"] for e in item["unobserved"]]
    assert events
    for event in events:
        assert {key: type(value) for key, value in event.items()} == {"step": int, "action": str}


def test_who_is_compared_shares_a_pair(lines: list[dict[str, Any]]) -> None:
    pairs: dict[str, set[str]] = {}
    for line in lines:
        pairs.setdefault(line["pair"], set()).add(line["robot"])
    assert list(pairs.values()) == [{"intentional", "traditional"}] * 3
    assert len({line["trial"] for line in lines}) == 6


def test_the_summary_has_every_key(run: Path) -> None:
    summary = json.loads((run / "summary.json").read_text(encoding="utf-8"))
    assert summary["trials"] == 6
    assert set(summary["scenarios"]) == {"1", "2", "5"}
    assert set(summary["levels"]) == {"coarse"}
    for group in [*summary["scenarios"].values(), *summary["levels"].values()]:
        assert {"pairs", "accuracy", "ratios", "p_values"} <= set(group)
        assert type(group["pairs"]) is int
        assert set(group["accuracy"]) == {"intentional", "traditional"}
        assert set(group["ratios"]) <= set(group["p_values"])
        assert set(group["holm"]) == set(group["effects"]) == set(group["p_values"])
        for count in ("failed_pairs", "incomplete", "unsolvable", "nothing_to_do", "without_event"):
            assert type(group[count]) is int
        for own in group["optimum"].values():
            assert set(own) == {"trials", "execution_units", "actions"}
    assert summary["scenarios"]["5"]["accuracy"] == {"intentional": 1.0, "traditional": 0.0}
    assert summary["scenarios"]["1"]["accuracy"] == {"intentional": None, "traditional": None}
    together = summary["levels"]["coarse"]
    assert (together["pairs"], together["failed_pairs"]) == (2, 1)
