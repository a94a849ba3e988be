"""A decision ends: by its budget the same way everywhere, by the clock with a mark on the trial."""

import json
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
import yaml
from typer.testing import CliRunner

from testbed.cli import app
from testbed.config import load_config
from testbed.experiment.digest import digest, logical
from testbed.experiment.plan import plan_trials
from testbed.experiment.record import TrialRecord
from testbed.experiment.robots import HUMAN, ROBOTS, make_robot
from testbed.experiment.trial import play_trial
from testbed.link import InProcessRobot

HARBOUR = """
sorts
  tug   = {nell}.
  barge = {ox, elk}.
  craft = tug + barge.
  dock  = {north, east, south}.
fluents
  inertial moored(craft, dock).
  inertial tows(tug, barge).
actions
  agent sail(tug, dock).
  agent hitch(tug, barge).
  agent slip(tug, barge).
  exogenous drift(barge, dock).
laws
  sail(T, D)  causes moored(T, D).
  hitch(T, B) causes tows(T, B).
  slip(T, B)  causes -tows(T, B).
  drift(B, D) causes moored(B, D).
  moored(B, D)   if moored(T, D), tows(T, B).
  -moored(C, D2) if moored(C, D1), D1 != D2.
  -tows(T, B1)   if tows(T, B2), B1 != B2.
  impossible sail(T, D)  if moored(T, D).
  impossible hitch(T, B) if tows(T, B1).
  impossible hitch(T, B) if moored(T, D1), moored(B, D2), D1 != D2.
  impossible slip(T, B)  if -tows(T, B).
  impossible drift(B, D) if moored(B, D).
  impossible drift(B, D) if tows(T, B).
initially
  moored(C, D) for some D.
sees
  T sees moored(T, D) if tug(T).
  T sees moored(B, D) if tug(T), moored(T, D).
  T sees tows(T, B).
shows
  sail(T, D1) shows moored(T, D2).
  hitch(T, B) shows tows(T, B).
  slip(T, B)  shows tows(T, B).
"""
OTHERS = ("intentional-nozoom", "intentional-joint", HUMAN)
ALONE = [name for name in ROBOTS.names() if name not in OTHERS]
"""Those that explain in a phase of its own, at the coarse resolution."""

NO_CLOCK = {"decision_s": None, "steps": 40, "plan": 8}

Harbour = Callable[..., Path]


@pytest.fixture
def harbour(tmp_path: Path) -> Harbour:
    """A configuration in which a barge drifts away while nobody looks, with other keys."""
    (tmp_path / "harbour.al").write_text(HARBOUR)

    def write(**keys: Any) -> Path:
        given: dict[str, Any] = {
            "name": "harbour",
            "domain": "harbour.al",
            "link": "inprocess",
            "initial": ["moored(nell,north)", "moored(ox,east)", "moored(elk,east)"],
            "goal": ["moored(ox,south)", "moored(elk,south)"],
            "script": [{"step": 1, "action": "drift(ox,north)"}],
            "exogenous_while_thinking": True,
            "limits": NO_CLOCK,
        }
        file = tmp_path / "harbour.yaml"
        file.write_text(yaml.safe_dump(given | keys))
        return file

    return write


def _played(config: Path, *overrides: str) -> list[TrialRecord]:
    client = InProcessRobot(make_robot)
    specs = plan_trials(load_config(str(config), overrides))
    return [play_trial(spec, client).record for spec in specs]


@pytest.mark.parametrize("robot", ALONE)
def test_without_a_budget_for_proofs_an_explanation_is_adopted_as_unproved(
    harbour: Harbour, robot: str
) -> None:
    """With one conflict nothing is left for the search for the smallest one."""
    (record,) = _played(harbour(robots=[robot]), "limits.conflicts=1")
    assert record.outcome == "achieved"
    assert record.explanations
    assert {own.minimal for own in record.explanations} == {"unproved"}
    assert not record.deadline


@pytest.mark.parametrize("robot", ALONE)
def test_the_budget_that_is_the_default_proves_the_same_trials(
    harbour: Harbour, robot: str
) -> None:
    config = harbour(robots=[robot])
    (record,) = _played(config)
    (unbounded,) = _played(
        config, "limits.conflicts=null", "limits.ground_rules=null", "limits.expansions=null"
    )
    assert {own.minimal for own in record.explanations} == {"proved"}
    ours, theirs = logical(record), logical(unbounded)
    assert ours["condition"] != theirs["condition"]
    assert ours == theirs | {key: ours[key] for key in ("trial", "pair", "condition")}


WAITING = [(robot, "ground_rules") for robot in ALONE]
WAITING += [(robot, "expansions") for robot in ("intentional", "traditional")]


@pytest.mark.parametrize(("robot", "limit"), WAITING)
def test_a_robot_without_a_budget_to_plan_waits(
    harbour: Harbour, tmp_path: Path, robot: str, limit: str
) -> None:
    config = harbour(robots=[robot], script=[])
    # Controls that an earlier trial has left are used as they are: these names are new.
    for file in (config, tmp_path / "harbour.al"):
        file.write_text(file.read_text().replace("nell", f"nell_{robot.replace('-', '_')}_{limit}"))
    (record,) = _played(config, f"limits.{limit}=1", "limits.steps=4")
    assert (record.outcome, record.steps, record.actions) == ("step_limit", 4, [])
    assert not record.deadline


MANY_EVENTS = Path(__file__).parent / "many_events.yaml"


def test_the_script_of_many_hidden_events_is_explained_within_the_budget() -> None:
    """25 events in 76 steps: what the history has led to is compressed, so that all is proved."""
    (record,) = _played(MANY_EVENTS, "limits.conflicts=2000")
    assert (record.outcome, len(record.exogenous)) == ("achieved", 25)
    assert {own.minimal for own in record.explanations} == {"proved"}
    sizes = [len(own.unobserved) for own in record.explanations]
    assert sizes == sorted(sizes)
    assert 16 < sizes[-1] <= 25


def test_where_nothing_is_compressed_many_hidden_events_are_explained_somehow(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """A proof would take minutes; an explanation has to do."""
    monkeypatch.setattr("asp.reasoning.diagnosis.incremental.COMPRESSION", None)
    (record,) = _played(MANY_EVENTS, "limits.decision_s=null")
    assert record.outcome == "achieved"
    assert len(record.exogenous) == 25
    last = record.explanations[-1]
    assert last.minimal == "unproved"
    assert {own.minimal for own in record.explanations[:-1]} == {"proved"}
    # The search kept what it had explained before, and found it to be nearly enough.
    assert len(last.unobserved) <= len(record.explanations[-2].unobserved) + 2


def test_what_a_process_played_before_does_not_matter_to_a_budget(harbour: Harbour) -> None:
    config = harbour(robots=["intentional", "traditional"])
    first = _played(config, "limits.conflicts=2001")
    _played(config, "limits.conflicts=null")
    assert list(map(logical, _played(config, "limits.conflicts=2001"))) == list(map(logical, first))


def test_a_trial_that_the_clock_cut_off_is_marked_and_counts_nowhere(
    harbour: Harbour, tmp_path: Path
) -> None:
    config, out = harbour(), tmp_path / "run"
    hurried = ["limits.decision_s=1e-9", "limits.steps=3", "script=[]"]
    arguments = ["run", str(config), *hurried, "--out", str(out), "--quiet"]
    assert CliRunner().invoke(app, arguments).exit_code == 0
    records = [json.loads(line) for line in (out / "trials.jsonl").read_text().splitlines()]
    assert [record["deadline"] for record in records] == [True, True]
    assert {record["outcome"] for record in records} == {"step_limit"}
    summary = json.loads((out / "summary.json").read_text())
    (scenario,) = summary["scenarios"].values()
    assert (summary["deadline"], scenario["deadline"], scenario["pairs"]) == (2, 1, 0)
    assert summary["digest"] == digest([])
    page = (out / "report.html").read_text()
    assert page.count(">deadline</span>") == 2
    printed = CliRunner().invoke(app, ["report", str(out)], env={"COLUMNS": "150"}).stdout
    assert printed.count("script, deadline ") == 2
    (line,) = [line for line in printed.splitlines() if line.startswith("digest of ")]
    assert [word for word in line.split() if word.isdigit()] == ["0", "2"]


def test_a_replay_says_that_an_explanation_is_unproved(harbour: Harbour, tmp_path: Path) -> None:
    config, out = harbour(robots=["intentional"]), tmp_path / "run"
    run = ["run", str(config), "limits.conflicts=1", "--out", str(out), "--quiet"]
    assert CliRunner().invoke(app, run).exit_code == 0
    trial = json.loads((out / "trials.jsonl").read_text())["trial"]
    told = CliRunner().invoke(app, ["replay", str(out), "--trial", trial])
    assert told.exit_code == 0
    assert "unproved" in told.output
