"""The examples run as a user would run them: from elsewhere, by their paths."""

import json
import runpy
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest

EXAMPLES = Path(__file__).parents[1] / "examples"


def _records(tmp_path: Path, name: str, *overrides: str) -> Iterator[dict[str, Any]]:
    command = [sys.executable, "-P", "-m", "testbed", "run", str(EXAMPLES / name), *overrides]
    done = subprocess.run(
        [*command, "--out", "run", "--workers", "1"],
        cwd=tmp_path,
        check=False,
        capture_output=True,
        text=True,
    )
    assert done.returncode == 0, done.stderr
    assert (tmp_path / "run" / "report.html").is_file()
    lines = (tmp_path / "run" / "trials.jsonl").read_text(encoding="utf-8").splitlines()
    return map(json.loads, lines)


def test_the_robot_plays_beside_the_built_in_ones(tmp_path: Path) -> None:
    played = {r["robot"]: r for r in _records(tmp_path, "custom_robot.yaml", "repeats=1")}
    assert played.keys() == {"custom_robot:Replanner", "intentional", "traditional"}
    own = played["custom_robot:Replanner"]
    assert own["outcome"] == "achieved", "it sees everything, and always has a plan"
    assert own["action_count"] >= own["minimal_actions"] > 0


def test_the_adversary_spoils_as_often_as_its_options_say(tmp_path: Path) -> None:
    twice = ["repeats=1", "robots=[intentional]", "adversary.options.times=2"]
    (record,) = _records(tmp_path, "custom_adversary.yaml", *twice)
    assert record["outcome"] == "achieved"
    events = record["exogenous"]
    assert len(events) == 2
    assert all(event["step"] >= 2 and event["action"].startswith("haul(") for event in events)


@pytest.mark.parametrize(
    ("name", "lacks"),
    [
        ("train_adversary.py", "sb3_contrib"),
        ("supersuit_vectors.py", "supersuit"),
        ("torchrl_rollout.py", "torchrl"),
    ],
)
def test_an_example_without_its_extra_says_so(
    name: str, lacks: str, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    for module in (lacks, "torchrl.envs"):
        monkeypatch.setitem(sys.modules, module, None)
    codes = []
    for argument in ("--help", "--steps=1"):
        monkeypatch.setattr(sys, "argv", [name, argument])
        with pytest.raises(SystemExit) as ended:
            runpy.run_path(str(EXAMPLES / name), run_name="__main__")
        codes.append(ended.value.code)
    assert codes[0] == 0
    assert "intention-testbed[train]" in str(codes[1])
    assert capsys.readouterr().err == ""


def test_games_of_supersuit_are_played() -> None:
    command = [sys.executable, str(EXAMPLES / "supersuit_vectors.py"), "--games", "2"]
    done = subprocess.run([*command, "--steps", "40"], check=False, capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    assert done.stdout.startswith("40 steps of 2 games")
