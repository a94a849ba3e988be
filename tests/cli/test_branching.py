"""Warnings of `check` and `translate`: actions with several outcomes, states that change alone."""

from pathlib import Path

import pytest
from typer.testing import CliRunner, Result

from asp.reasoning import determinism
from asp.solving import Limits
from asp.translation import translate
from testbed.cli import app
from tests.asp.reasoning.branching import DIE, DOOR, RESTLESS

CONFIG = 'name: own\ndomain: own.al\ngoal: ["{}"]\nrobots: [intentional]\n'
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
