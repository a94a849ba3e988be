"""A robot that gives up says why: as it believes, nothing achieves its goal, or a long plan."""

import json
import subprocess
import sys
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import pytest

ROBOTS = ["intentional", "intentional-plain", "traditional", "traditional-plain"]
RAFTS = """
sorts
  bank = {east, west}.
  far_bank = {island}.
  place = bank + far_bank.
  robot = {ferry}.
  crate = {c1, c2}.
statics
  linked(place, place).
fluents
  inertial at(robot, place).
  inertial lost(crate).
  inertial ashore(crate).
actions
  agent sail(robot, place).
  agent land(robot, crate).
  exogenous sink(crate).
laws
  sail(R, P) causes at(R, P).
  land(R, C) causes ashore(C).
  sink(C) causes lost(C).
  -at(R, P) if at(R, Q), P != Q.
  impossible sail(R, Q) if at(R, P), -linked(P, Q).
  impossible land(R, C) if lost(C).
  impossible land(R, C) if -at(R, island).
facts
  linked(east, west).
  linked(west, island).
sees
  R sees at(R, P) if robot(R).
  R sees ashore(C) if at(R, P).
"""
"""A ferry lands crates on an island, two legs away; what sinks is lost, which it cannot see."""


def _trials(folder: Path, robots: Sequence[str], *given: str) -> list[dict[str, Any]]:
    (folder / "rafts.al").write_text(RAFTS)
    (folder / "rafts.yaml").write_text(
        "name: rafts\ndomain: rafts.al\nlink: inprocess\nscript: []\n"
        'initial: ["at(ferry,east)"]\ngoal: ["ashore(c1)"]\n'
    )
    command = [sys.executable, "-m", "testbed", "run", "rafts.yaml", f"robots=[{','.join(robots)}]"]
    done = subprocess.run(
        [*command, *given, "--out", "out"], cwd=folder, capture_output=True, text=True
    )
    assert done.returncode == 0, done.stderr
    lines = (folder / "out/trials.jsonl").read_text(encoding="utf-8").splitlines()
    return [json.loads(line) for line in lines]


@pytest.mark.parametrize(
    ("given", "no_plan", "in_reach"),
    [
        (["limits.plan=2"], "beyond the limit", True),
        (['initial=["at(ferry,east)","lost(c1)"]'], "out of reach", False),
    ],
    ids=["limit", "no way"],
)
def test_the_record_says_which_it_is(
    tmp_path: Path, given: list[str], no_plan: str, in_reach: bool
) -> None:
    trials = _trials(tmp_path, ROBOTS, *given)
    found = {t["robot"]: (t["outcome"], t["no_plan"], t["in_reach"]) for t in trials}
    assert found == dict.fromkeys(ROBOTS, ("gave_up", no_plan, in_reach))
    traditional = next(t["trial"] for t in trials if t["robot"] == "traditional")
    command = [sys.executable, "-m", "testbed", "replay", "out", "--trial", traditional]
    replayed = subprocess.run(command, cwd=tmp_path, capture_output=True, text=True)
    assert replayed.returncode == 0, replayed.stderr
    assert no_plan in replayed.stdout


def test_a_robot_that_does_not_give_up_has_no_such_reason(tmp_path: Path) -> None:
    (trial,) = _trials(tmp_path, ["traditional"])
    assert (trial["outcome"], trial["no_plan"]) == ("achieved", None)
