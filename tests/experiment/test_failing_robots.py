"""A robot's own error counts everywhere; what something else ended is told apart everywhere."""

import json
import re
from collections.abc import Callable
from pathlib import Path
from typing import Any

import polars as pl
import pytest
from typer.testing import CliRunner

from testbed.analysis.pairs import Compared
from testbed.analysis.table import table_of
from testbed.cli import app
from testbed.experiment.plan import plan_trials
from testbed.experiment.robots import make_robot
from testbed.experiment.run_folder import write_config
from testbed.experiment.store import TrialWriter, read_records
from testbed.experiment.trial import play_trial
from testbed.link import InProcessRobot
from testbed.protocol import Decision, Percept, RobotGone, RobotStops, Task
from testbed.studies.table1.measures import analyse
from testbed.studies.table1.pairs import pairs_in
from testbed.world import load_world
from tests.experiment.samples import Configure, a_level_record, summary_of
from tests.studies.levels.found import columns

PAIRS = 4
FAILURES: dict[str, Callable[[], Exception]] = {
    "stops": lambda: RobotStops("inconsistent history"),
    "raises": lambda: ValueError("out of ideas"),
    "gone": lambda: RobotGone("process ended with signal 9"),
    "broken": lambda: OSError("no space left on device"),
}
OWN = ("stops", "raises")


class Failing:
    """A robot that fails at its third step, and is else another one; behind no link at all."""

    def __init__(self, kind: str, failure: Exception) -> None:
        self._robot, self._failure = make_robot(kind), failure

    def begin(self, task: Task) -> None:
        self._robot.begin(task)

    def act(self, percept: Percept) -> Decision:
        if percept.step == 3:
            raise self._failure
        return self._robot.act(percept)

    ask = act

    def close(self) -> None:
        pass


@pytest.fixture(params=FAILURES)
def failing(request: pytest.FixtureRequest, configure: Configure, tmp_path: Path) -> Any:
    """A run in which one of four trials of the intentional robot fails, and what for."""
    config = configure("scenarios=[1]", f"limit={PAIRS}", "initial=null", "seed=1")
    specs = plan_trials(config)
    victim = next(spec for spec in specs if spec.robot == "intentional")
    write_config(tmp_path, config)
    with TrialWriter(tmp_path) as writer:
        for spec in specs:
            if spec is not victim:
                client: Any = InProcessRobot(make_robot)
            else:
                robot = Failing(spec.robot, FAILURES[request.param]())
                client = InProcessRobot(lambda _, r=robot: r) if request.param in OWN else robot
            writer.append(play_trial(spec, client).record)
    return tmp_path, request.param in OWN


def test_summary_table_report_and_export_have_one_accuracy(failing: Any) -> None:
    folder, own = failing
    shown = CliRunner().invoke(app, ["report", str(folder)], env={"COLUMNS": "150"})
    assert shown.exit_code == 0, shown.output
    counted, right = (PAIRS, PAIRS - 1) if own else (PAIRS - 1, PAIRS - 1)
    group = json.loads((folder / "summary.json").read_text(encoding="utf-8"))["scenarios"]["1"]
    assert group["accuracy"]["intentional"] == right / counted
    assert group["robot_errors"] == {"intentional": int(own), "traditional": 0}
    assert (group["pairs"], group["failed_pairs"]) == (counted, int(not own))
    (line,) = (li for li in shown.stdout.splitlines() if re.search(r"\bintentional\b", li))
    assert f" {right}/{counted}" in line
    assert ("1 lost" in line) is not own
    page = (folder / "report.html").read_text(encoding="utf-8")
    assert f"{100 * right / counted:.1f} %" in page
    CliRunner().invoke(app, ["export", str(folder)])
    trials = pl.read_parquet(folder / "trials.parquet").filter(pl.col("robot") == "intentional")
    assert trials["correct"].mean() == right / counted


def test_a_robots_own_error_is_in_no_ratio(failing: Any) -> None:
    """What it did by then says nothing of what it would have needed."""
    folder, _ = failing
    CliRunner().invoke(app, ["report", str(folder)])
    group = json.loads((folder / "summary.json").read_text(encoding="utf-8"))["scenarios"]["1"]
    assert group["ratios"]["actions"] == 1.0
    assert group["ratios_of_sums"]["actions"] == 1.0


def test_table_1_counts_it_as_the_summary_does(failing: Any) -> None:
    folder, own = failing
    records = list(read_records(folder))
    robots = Compared("traditional", "intentional")
    pairs = pairs_in(table_of(records), load_world("office"), robots, ())
    table = analyse(pairs, robots).tables["triggered"]
    row = next(row for row in table.rows if row.name == "1")
    assert row.treatment is not None
    group: Any = summary_of(records)["scenarios"]
    assert row.treatment.value == group["1"]["accuracy"]["intentional"]
    assert (row.pairs, row.left_out["failed"]) == ((PAIRS, 0) if own else (PAIRS - 1, 1))


@pytest.mark.parametrize(("cause", "trials"), [("robot", 2), ("infrastructure", 1), ("testbed", 1)])
def test_levels_count_it_as_not_completed(cause: str, trials: int) -> None:
    correct = False if cause == "robot" else None
    failed = {"achieved": False, "outcome": "error", "cause": cause, "correct": correct}
    records = [a_level_record("p", "intentional"), a_level_record("q", "intentional", **failed)]
    group: Any = summary_of(records)["levels"]
    assert group["L3"]["accuracy"]["intentional"] == 1 / trials
    level = columns(records)["L3"]
    reasoning = level["reasoning"]["intentional"]
    assert (reasoning["trials"], reasoning["completed"]) == (trials, 1 / trials)
    assert level["compared"]["correct"]["intentional"]["value"] == 1 / trials
