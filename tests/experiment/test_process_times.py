"""Process time of a robot: in the record of every trial, and nothing of it in nobody's account."""

import json
import subprocess
import sys
import time
from collections.abc import Callable
from itertools import pairwise
from pathlib import Path
from typing import Any

import pytest

from testbed.config import load_config
from testbed.experiment.plan import plan_trials
from testbed.experiment.record import TrialRecord
from testbed.experiment.robots import make_robot
from testbed.experiment.trial import play_trial
from testbed.link import InProcessRobot
from testbed.protocol import Decision, Percept

CPU_TIMES = ("planning_cpu_s", "diagnosis_cpu_s", "preparation_cpu_s")


def _stacking(folder: Path, name: str) -> Path:
    """A configuration of stacking four things of this name, so that no other test has prepared it.

    At first all of them stand on `lab`.
    """
    things = [f"{name}{number}" for number in range(4)]
    start = [f"on({thing},lab)" for thing in things]
    goal = [f"on({upper},{lower})" for lower, upper in pairwise(things)]
    folder.joinpath("flasks.al").write_text(
        f"""
        sorts
          flask = {{{", ".join(things)}}}.
          base = {{lab}}.
          place = flask + base.
          robot = {{arm}}.
        fluents
          inertial on(flask, place).
          inertial busy(robot).
          defined covered(flask).
        actions
          agent put(robot, flask, place).
        laws
          put(R, F, P) causes on(F, P).
          -on(F, P) if on(F, Q), P != Q.
          covered(F) if on(G, F).
          impossible put(R, F, P) if covered(F).
          impossible put(R, F, G) if covered(G).
          impossible put(R, F, P) if on(F, P).
          impossible put(R, F, F).
        sees
          R sees on(F, P) if robot(R).
        """
    )
    config = folder / "flasks.yaml"
    config.write_text(
        json.dumps({"name": "flasks", "domain": "flasks.al", "initial": start, "goal": goal})
    )
    return config


class _Metered(InProcessRobot):
    """Measures the process time of all that its robot is asked."""

    spent = 0.0

    def ask(self, percept: Percept) -> Decision:
        began = time.process_time()
        try:
            return super().ask(percept)
        finally:
            self.spent += time.process_time() - began


def _played(config: Path, robot: str) -> tuple[TrialRecord, float]:
    (spec,) = plan_trials(load_config(str(config), [f"robots=[{robot}]", "link=inprocess"]))
    client = _Metered(make_robot)
    return play_trial(spec, client).record, client.spent


@pytest.mark.parametrize("robot", ["intentional", "traditional"])
def test_what_a_robot_uses_is_in_its_accounts(tmp_path: Path, robot: str) -> None:
    record, spent = _played(_stacking(tmp_path, f"{robot}_flask"), robot)
    assert record.outcome == "achieved"
    times = [getattr(record, key) for key in CPU_TIMES]
    assert min(times) >= 0.0
    assert spent / 2 < sum(times) <= spent


def test_what_was_prepared_once_is_not_prepared_again(tmp_path: Path) -> None:
    config = _stacking(tmp_path, "jar")
    (first, _), (second, _) = _played(config, "intentional"), _played(config, "intentional")
    assert second.actions == first.actions
    assert second.preparation_cpu_s < first.preparation_cpu_s / 2


@pytest.fixture
def over_zenoh(tmp_path: Path) -> Callable[[str], list[dict[str, Any]]]:
    def run(config: str) -> list[dict[str, Any]]:
        command = [sys.executable, "-m", "testbed", "run", config, "link=zenoh", "--out", "out"]
        subprocess.run(command, check=True, cwd=tmp_path, capture_output=True)
        lines = (tmp_path / "out/trials.jsonl").read_text(encoding="utf-8").splitlines()
        return [json.loads(line) for line in lines]

    return run


def test_the_times_of_a_robot_in_a_process_of_its_own_travel(
    tmp_path: Path, over_zenoh: Callable[[str], list[dict[str, Any]]]
) -> None:
    trials = over_zenoh(str(_stacking(tmp_path, "vial")))
    assert {trial["robot"] for trial in trials} == {"intentional", "traditional"}
    for trial in trials:
        assert [key for key in CPU_TIMES if trial[key] <= 0.0] == []
        # A process that runs alone in its threads cannot use much more than passes by the wall.
        assert trial["planning_cpu_s"] + trial["diagnosis_cpu_s"] < 2 * trial["wall_time_s"]
