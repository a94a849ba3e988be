"""`testbed replay --program`: what clingo alone finds in the program of a decision."""

import subprocess
import sys
from pathlib import Path
from shutil import copytree

import pytest
from click.testing import Result
from typer.testing import CliRunner

from testbed.cli import app
from testbed.cli.programs import replay_decisions
from testbed.experiment.record import At, TrialRecord
from testbed.experiment.store import TrialWriter, read_records
from tests.solved_programs import found_by_clingo

KILN = """
% A potter's kiln: somebody may open it, and put the fire out.
sorts
  pot  = {jug, bowl}.
  hand = {ann}.
fluents
  inertial fired(pot).
  inertial hot.
  inertial shut.
actions
  agent     fire(hand, pot).
  agent     light(hand).
  agent     close(hand).
  exogenous open_up.
  exogenous chill(pot).
laws
  fire(H, P) causes fired(P).
  light(H)   causes hot.
  close(H)   causes shut.
  open_up    causes -shut.
  open_up    causes -hot.
  chill(P)   causes -fired(P).
  impossible fire(H, P) if -hot.
  impossible light(H)   if -shut.
  impossible light(H)   if hot.
  impossible close(H)   if shut.
  impossible open_up    if -shut.
  impossible chill(P)   if -fired(P).
sees
  H sees fired(P) if hand(H).
shows
  fire(H, P1) shows fired(P2).
scenarios
  quiet: nothing.
"""
RELAY = """
from dataclasses import replace

from agents.intentional import IntentionalRobot


class Relay:
    capabilities = replace(IntentionalRobot.capabilities, snapshots=False)
    watcher = None

    def begin(self, task):
        self._own = IntentionalRobot()
        self._own.watcher = self.watcher
        self._own.begin(task)

    def act(self, percept):
        return self._own.act(percept)
"""
CONFIG = """
name: kiln
domain: kiln.al
goal: ["fired(jug)", "fired(bowl)"]
initial: ["-fired(jug)", "-fired(bowl)", "-hot", "shut"]
script: [{step: 3, action: open_up}, {step: 9, action: "chill(jug)"}]
robots: [intentional, intentional-joint, intentional-checking, traditional]
limits: {plan: 5, decision_s: null}
link: inprocess
"""


def _recorded(record: TrialRecord) -> dict[int, str]:
    """The intention of each step, by the record."""
    own: list[At] = [*record.actions, *record.mental]
    return {each.step: str(each.action) for each in own}


def _call(*arguments: str) -> Result:
    return CliRunner().invoke(app, arguments)


def _found_again(folder: Path, record: TrialRecord) -> list[str]:
    """The recorded intentions, each of which clingo finds in the program of its step."""
    decisions, intentions = replay_decisions(folder, record.trial), _recorded(record)
    assert set(intentions) == set(range(1, record.steps + 1))
    plans = {activity.start: [*map(str, activity.plan)] for activity in record.activities}
    for step, intention in intentions.items():
        found = found_by_clingo(decisions.program(step))
        assert found.intention == intention
        assert found.plan == plans.get(step, [])
    return list(intentions.values())


def test_clingo_alone_finds_every_intention_of_the_quickstart(tmp_path: Path) -> None:
    folder = tmp_path / "run"
    given = ("link=inprocess", "robots=[intentional]", "--workers", "1", "--quiet")
    assert _call("run", "quickstart", *given, "--out", str(folder)).exit_code == 0
    records = list(read_records(folder))
    assert {record.scenario for record in records} == set("123456")
    found = [intention for record in records for intention in _found_again(folder, record)]
    assert {"start", "stop", "finish", "move"} <= {each.partition("(")[0] for each in found}


@pytest.fixture(scope="module")
def played(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A run in another domain, in which events surprise the robots."""
    tmp_path = tmp_path_factory.mktemp("kiln")
    (tmp_path / "kiln.al").write_text(KILN, encoding="utf-8")
    (tmp_path / "kiln.yaml").write_text(CONFIG, encoding="utf-8")
    folder = tmp_path / "run"
    given = ("--workers", "1", "--quiet", "--out", str(folder))
    assert _call("run", str(tmp_path / "kiln.yaml"), *given).exit_code == 0
    return folder


@pytest.fixture
def kiln(played: Path, tmp_path: Path) -> Path:
    """The same with its configuration beside it, to be changed."""
    copytree(played.parent, tmp_path, dirs_exist_ok=True)
    return tmp_path / "run"


def _record(folder: Path, robot: str) -> TrialRecord:
    (record,) = (own for own in read_records(folder) if own.robot == robot)
    return record


@pytest.mark.parametrize("robot", ["intentional", "intentional-joint", "intentional-checking"])
def test_so_it_does_in_any_domain_and_of_any_intentional_robot(kiln: Path, robot: str) -> None:
    record = _record(kiln, robot)
    assert record.explanations
    assert _found_again(kiln, record)


def test_so_it_does_of_a_robot_of_ones_own_that_is_watched(kiln: Path, tmp_path: Path) -> None:
    (kiln.parent / "potters_relay.py").write_text(RELAY, encoding="utf-8")
    folder = tmp_path / "relayed"
    given = ("robots=[potters_relay:Relay]", "--workers", "1", "--quiet", "--out", str(folder))
    assert _call("run", str(kiln.parent / "kiln.yaml"), *given).exit_code == 0
    trial = _record(folder, "potters_relay:Relay").trial
    asked = _call("replay", str(folder), "--trial", trial, "--step", "1", "--program")
    assert asked.exit_code == 0
    assert found_by_clingo(asked.stdout).intention == "start(1)"


def test_a_robot_that_gives_up_has_a_program_too(kiln: Path, tmp_path: Path) -> None:
    folder = tmp_path / "short"
    given = ("limits.plan=2", "robots=[intentional]", "--workers", "1", "--out", str(folder))
    assert _call("run", str(kiln.parent / "kiln.yaml"), *given).exit_code == 0
    record = _record(folder, "intentional")
    assert record.outcome == "gave_up"
    assert _found_again(folder, record)[-1] == "finish"


def test_a_file_is_all_that_the_command_of_clingo_needs(kiln: Path, tmp_path: Path) -> None:
    record, file = _record(kiln, "intentional"), tmp_path / "decision.lp"
    asked = ("--trial", record.trial, "--step", "1", "--program")
    printed = _call("replay", str(kiln), *asked)
    written = _call("replay", str(kiln), *asked, "-o", str(file))
    assert (written.exit_code, written.stdout) == (0, "")
    assert file.read_text(encoding="utf-8") == printed.stdout
    command = [sys.executable, "-m", "clingo", str(file)]
    answer = subprocess.run(command, capture_output=True, text=True, check=False, cwd=tmp_path)
    assert "intended_action(start(1),1)" in answer.stdout
    assert not answer.stderr
    # The horizon is that of a shortest plan: there is no shorter one.
    lines = printed.stdout.splitlines()
    (horizon,) = (own for own in lines if own.startswith("#const n =") and "override" in own)
    shorter = int(horizon.split()[3].rstrip(".")) - 1
    changed = printed.stdout.replace(horizon, f"#const n = {shorter}. [override]")
    file.write_text(changed, encoding="utf-8")
    answer = subprocess.run(command, capture_output=True, text=True, check=False, cwd=tmp_path)
    assert "UNSATISFIABLE" in answer.stdout


@pytest.mark.parametrize(
    ("robot", "options", "named"),
    [
        ("traditional", ("--step", "2", "--program"), "traditional"),
        ("intentional", ("--step", "0", "--program"), "step 0"),
        ("intentional", ("--step", "400", "--program"), "step 400"),
        ("intentional", ("--program",), "--step"),
        ("intentional", ("--step", "2"), "--program"),
        ("intentional", ("-o", "here.lp"), "--program"),
        ("intentional", ("--step", "1", "--program", "-o", "nowhere/here.lp"), "nowhere/here.lp"),
    ],
)
def test_what_has_no_program_is_refused_in_one_line(
    kiln: Path, robot: str, options: tuple[str, ...], named: str
) -> None:
    refused = _call("replay", str(kiln), "--trial", _record(kiln, robot).trial, *options)
    assert (refused.exit_code, refused.stdout) == (2, "")
    (line,) = refused.stderr.splitlines()
    assert named in line


def test_a_trial_that_goes_otherwise_than_on_record_has_no_program(kiln: Path) -> None:
    record = _record(kiln, "intentional")
    last = record.actions[-1]
    last.happened = not last.happened
    (kiln / "trials.jsonl").unlink()
    with TrialWriter(kiln) as writer:
        writer.append(record)
    asked = ("replay", str(kiln), "--trial", record.trial, "--program", "--step")
    assert _call(*asked, str(last.step - 1)).exit_code == 0
    refused = _call(*asked, str(last.step))
    assert (refused.exit_code, refused.stdout) == (2, "")
    (line,) = refused.stderr.splitlines()
    assert record.trial in line


def test_conformant_plans_have_no_program(kiln: Path, tmp_path: Path) -> None:
    folder = tmp_path / "conformant"
    given = ("plans=conformant", "robots=[intentional]", "--workers", "1", "--out", str(folder))
    assert _call("run", str(kiln.parent / "kiln.yaml"), *given).exit_code == 0
    trial = _record(folder, "intentional").trial
    refused = _call("replay", str(folder), "--trial", trial, "--step", "1", "--program")
    assert (refused.exit_code, refused.stdout) == (2, "")
    (line,) = refused.stderr.splitlines()
    assert "conformant" in line


def test_so_it_does_at_the_fine_resolution(tmp_path: Path) -> None:
    folder = tmp_path / "fine"
    given = ("link=inprocess", "levels=[L1]", "limit=1", "robots=[intentional]", "--workers", "1")
    assert _call("run", "levels", *given, "--quiet", "--out", str(folder)).exit_code == 0
    record = _record(folder, "intentional")
    decisions, plan = replay_decisions(folder, record.trial), record.activities[0].plan
    found = found_by_clingo(decisions.program(1))
    assert (found.intention, found.plan) == ("start(1)", [*map(str, plan)])
    last = found_by_clingo(decisions.program(max(decisions.programs)))
    assert last.intention == "finish"
    # While an abstract action is carried out nothing is decided at the coarse resolution.
    between = set(range(1, record.steps)).difference(decisions.programs)
    asked = ("--trial", record.trial, "--step", str(min(between)), "--program")
    refused = _call("replay", str(folder), *asked)
    assert (refused.exit_code, len(refused.stderr.splitlines())) == (2, 1)
