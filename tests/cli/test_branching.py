"""Warnings of `check` and `translate`: actions with several outcomes, states that change alone."""

import json
import shutil
from pathlib import Path
from typing import Any

import clingo
import pytest
from typer.testing import CliRunner, Result

from asp.reasoning import determinism, qualifications
from asp.solving import Limits
from asp.translation import translate
from testbed.cli import app
from tests.asp.reasoning.branching import CRATES, DIE, DOOR, RESTLESS

CONFIG = 'name: own\ndomain: own.al\ngoal: ["{}"]\nrobots: [intentional]\n'
PLAYED = """
name: crates
domain: own.al
goal: ["-high(large)"]
initial: ["high(large)", "whole(large)"]
scenarios: none
robots: [intentional, intentional-plain]
link: inprocess
limits: {plan: 4, steps: 12}
"""
DOOR_PLAYED = """
name: door
domain: own.al
goal: ["outside"]
initial: ["shut", "loose"]
scenarios: none
robots: [intentional]
link: inprocess
limits: {plan: 5, steps: 14}
"""
JARS = """\
sorts
  cook = {ada}.
  jar  = {tall, flat}.
fluents
  inertial lidded(jar).
  inertial brimming(jar).
  inertial washed(jar).
actions
  agent wash(jar).
  agent cap(jar).
  agent pour(jar).
  exogenous overfill(jar).
sees
  ada sees lidded(J).
laws
  wash(J) causes washed(J).
  cap(J) causes lidded(J) if washed(J).
  pour(J) causes -brimming(J).
  overfill(J) causes brimming(J).
  -lidded(J) if brimming(J).
"""
JARS_PLAYED = """
name: jars
domain: own.al
goal: ["lidded(tall)"]
initial: []
script: [{at_action: 1, action: overfill(tall)}]
robots: [intentional, intentional-joint]
link: inprocess
limits: {plan: 3, steps: 16}
"""
NAMED = [
    (DIE, "up(one)", ("throw", "up(", "|")),
    (DOOR, "outside", ("pull", "shut", "loose")),
    (RESTLESS, "awake", ("awake", "alert", "nothing")),
]


@pytest.fixture(autouse=True)
def _here(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)


def _call(*arguments: str) -> Result:
    return CliRunner().invoke(app, list(arguments))


def _written(text: str, goal: str) -> None:
    Path("own.al").write_text(text, encoding="utf-8")
    Path("own.yaml").write_text(CONFIG.format(goal), encoding="utf-8")


def _warnings(result: Result) -> list[str]:
    assert result.exit_code == 0, result.output
    return result.stderr.splitlines()


@pytest.mark.parametrize(("text", "goal", "named"), NAMED)
def test_one_line_names_the_file_the_action_the_state_and_the_outcomes(
    text: str, goal: str, named: tuple[str, ...]
) -> None:
    _written(text, goal)
    for command, file in ("translate", "own.al"), ("check", "own.yaml"):
        (line,) = _warnings(_call(command, file))
        assert all(word in line for word in ("own.al", "warning", *named))


def test_the_program_on_standard_output_is_the_program_alone() -> None:
    _written(DIE, "up(one)")
    assert _call("translate", "own.al").stdout == translate(DIE, "own.al")


@pytest.mark.parametrize("arguments", [("translate", "office"), ("check", "quickstart")])
def test_where_every_action_has_one_outcome_nothing_is_said(arguments: tuple[str, ...]) -> None:
    assert not _warnings(_call(*arguments))


def test_a_search_that_comes_to_no_end_is_said_to_have_come_to_none(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setattr(determinism, "LIMITS", Limits(ground_rules=1))
    _written(DIE, "up(one)")
    (line,) = _warnings(_call("translate", "own.al"))
    assert "own.al" in line
    assert "throw" not in line


def test_an_action_whose_effects_contradict_a_constraint_is_told_of_once() -> None:
    _written(JARS, "lidded(tall)")
    (line,) = _warnings(_call("check", "own.yaml"))
    assert all(word in line for word in ("own.al", "warning", "cap(", "brimming("))
    _written(JARS + "  impossible cap(J) if brimming(J).\n", "lidded(tall)")
    assert not _warnings(_call("check", "own.yaml"))


def test_a_search_for_such_actions_may_come_to_no_end(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(qualifications, "MOST_CASES", 0)
    _written(JARS, "lidded(tall)")
    (line,) = _warnings(_call("check", "own.yaml"))
    assert "own.al" in line
    assert "cap(" not in line


def test_a_plan_may_be_asked_to_be_conformant() -> None:
    Path("own.al").write_text(CRATES, encoding="utf-8")
    asked = ("plan", "own.al", "--from", "high(large), whole(large)", "--goal", "-high(large)")
    assert _call(*asked).stdout.split() == ["tip(large)"]
    assert _call(*asked, "--conformant").stdout.split() == ["tie(large)", "lower(large)"]
    assert _call(*asked, "--conformant", "--limit", "1").exit_code == 1


def _played(*overrides: str) -> dict[str, dict[str, Any]]:
    """The records of a run with the crates, by robot."""
    Path("own.al").write_text(CRATES, encoding="utf-8")
    Path("own.yaml").write_text(PLAYED, encoding="utf-8")
    result = _call("run", "own.yaml", *overrides, "--out", "run", "--quiet")
    assert result.exit_code == 0, result.output
    lines = Path("run", "trials.jsonl").read_text(encoding="utf-8").splitlines()
    return {record["robot"]: record for record in map(json.loads, lines)}


def _actions(record: dict[str, Any]) -> list[str]:
    return [each["action"] for each in record["actions"]]


def test_robots_make_the_plans_that_the_configuration_asks_for() -> None:
    for record in _played("plans=conformant").values():
        assert record["outcome"] == "achieved"
        assert _actions(record) == ["tie(large)", "lower(large)"]


def test_an_outcome_that_was_not_expected_is_on_record_and_the_robot_recovers() -> None:
    for seed in range(8):
        records = _played(f"seed={seed}", "plans=optimistic")
        assert all(_actions(each)[0] == "tip(large)" for each in records.values())
        assert records["intentional"]["outcome"] == "achieved"
        assert _actions(records["intentional"]) == _actions(records["intentional-plain"])
        if _actions(records["intentional"])[1:]:
            break
        shutil.rmtree("run")
    else:
        raise AssertionError("with some seed the crate breaks")
    (explained,) = records["intentional"]["explanations"]
    assert explained["outcomes"] == [{"step": 2, "action": "tip(large)"}]
    assert not explained["unobserved"]
    assert _actions(records["intentional"])[1:] == ["tie(large)", "lower(large)"]


def test_a_robot_that_makes_no_conformant_plans_is_not_asked_for_them() -> None:
    _written(DIE, "up(one)")
    asked = ("check", "own.yaml", "plans=conformant")
    assert _call(*asked).exit_code == 0
    result = _call(*asked, "robots=[intentional-joint]")
    assert result.exit_code == 2
    assert "intentional-joint" in result.stderr
    assert "plans: optimistic" in result.stderr
    result = _call("check", "own.yaml", "plans=hopeful")
    assert result.exit_code == 2
    assert "plans" in result.stderr


def _solved_one_by_one(text: str, config: str) -> dict[str, list[str]]:
    """What each robot intended at each step, as clingo says and as the run did."""
    Path("own.al").write_text(text, encoding="utf-8")
    Path("own.yaml").write_text(config, encoding="utf-8")
    assert _call("run", "own.yaml", "seed=1", "--out", "run", "--quiet").exit_code == 0
    told = {}
    for line in Path("run", "trials.jsonl").read_text(encoding="utf-8").splitlines():
        record = json.loads(line)
        asked = ("replay", "run", "--trial", record["trial"], "--program", "--step")
        steps = range(1, record["steps"] + 1)
        answers = [_solved(_call(*asked, str(step)).stdout) for step in steps]
        mental = {each["step"]: each["action"] for each in record["mental"]}
        physical = {each["step"]: each["action"] for each in record["actions"]}
        assert answers == [(mental | physical)[step] for step in steps]
        told[record["robot"]] = answers
    return told


def test_clingo_alone_solves_the_program_of_each_decision() -> None:
    """Whether an activity is futile depends on outcomes."""
    assert _solved_one_by_one(DOOR, DOOR_PLAYED)


def test_clingo_alone_solves_those_about_what_no_state_could_follow() -> None:
    """The jar was overfilled unseen: an attempt to cap it fails, and is explained."""
    for answers in _solved_one_by_one(JARS, JARS_PLAYED).values():
        attempts = [answer for answer in answers if answer.endswith("(tall)")]
        assert attempts == ["wash(tall)", "cap(tall)", "pour(tall)", "cap(tall)"]


def _solved(program: str) -> str:
    """The intended action in the last answer set."""
    control = clingo.Control(["--warn=none"])
    control.add("base", [], program)
    control.ground([("base", [])])
    found: list[str] = []
    control.solve(
        on_model=lambda model: found.extend(
            str(symbol.arguments[0])
            for symbol in model.symbols(shown=True)
            if symbol.match("intended_action", 2)
        )
    )
    return found[-1]
