"""One trial as one file: it replays by itself, wherever the file lies."""

import json
import os
import shutil
import subprocess
import sys
from pathlib import Path
from typing import Any

import polars as pl
import pytest
from typer.testing import CliRunner, Result

from benchmarks.own import Own
from testbed.analysis.export import export
from testbed.cli import app
from testbed.config import load_config
from testbed.experiment.runner import run
from testbed.registry import PATH_VARIABLE
from tests.experiment.gardens import GARDEN, ROWS
from tests.greenhouse import GREENHOUSE

ROOT = Path(__file__).parents[2]
RAKED = GARDEN.replace("OTHER", "rake")
POTS = {
    "goal": ["stands(fern,sill)", "stands(rose,bench)"],
    "initial": ["stands(fern,bench)", "stands(rose,floor)"],
    "script": [{"step": 3, "action": "blow(fern,floor)"}],
    "scenarios": "none",
    "robots": ["intentional"],
    "sweep": {"grid": {"goal_feedback": [True, False]}},
}
BEDS = {
    "goal": ["stands(spade,south)", "-carries(tom,spade)"],
    "robots": ["intentional"],
    "sweep": {"grid": {"adversary.rate": [0, 0.4]}},
}
OFFICE = """\
name: mine
domain: office
goal: ["loc(book1,library)", "-in_hand(rob1,book1)"]
initial: ["loc(rob1,office2)", "loc(book1,office1)", "loc(book2,kitchen)"]
scenarios: none
script: [{step: 3, action: "exo_move(book1,kitchen)"}]
script_policy: skip
robots: [intentional, traditional]
sweep: {grid: {knowledge: [complete, seen]}}
"""
MADE = """\
name: mine
levels: [L1]
limit: 1
robots: [intentional]
sweep: {grid: {adversary.rate: [0, 0.2]}}
"""


@pytest.fixture(autouse=True)
def _elsewhere(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Nothing is found that lies in the working directory, or where a run was configured."""
    monkeypatch.setenv(PATH_VARIABLE, "")
    monkeypatch.setattr(sys, "path", list(sys.path))
    (tmp_path / "away").mkdir()
    monkeypatch.chdir(tmp_path / "away")


def _call(*arguments: str | Path) -> Result:
    return CliRunner().invoke(app, [str(part) for part in arguments])


def _refused(*arguments: str | Path) -> str:
    done = _call(*arguments)
    assert done.exit_code == 2, done.output
    (line,) = done.stderr.splitlines()
    return line


def _played(config: Path, folder: Path) -> list[dict[str, Any]]:
    """The records of a run."""
    run(load_config(config, ["link=inprocess"]), folder, workers=0)
    return [json.loads(line) for line in (folder / "trials.jsonl").read_text("utf-8").splitlines()]


def _last(folder: Path) -> str:
    """The last line of a run, which is of the last condition."""
    return (folder / "trials.jsonl").read_text("utf-8").splitlines()[-1]


def _written(tmp_path: Path, text: str) -> Path:
    (tmp_path / "mine.yaml").write_text(text, encoding="utf-8")
    return tmp_path / "mine.yaml"


@pytest.fixture
def pots(tmp_path: Path) -> Path:
    """A run in a domain of its own, scripted and swept."""
    _played(Own(tmp_path, GREENHOUSE).write(**POTS), tmp_path / "run")
    return tmp_path / "run"


@pytest.fixture
def row(pots: Path, tmp_path: Path) -> Path:
    """A trial of it as a file, which is all that there is any more."""
    trial = json.loads(_last(pots))["trial"]
    file = tmp_path / "away" / "row.json"
    assert _call("replay", pots, "--trial", trial, "--row", "-o", file).exit_code == 0
    return file


def _changed(row: Path, **values: object) -> Path:
    """The same row with other values, written by somebody else: without a checksum."""
    known = json.loads(row.read_text("utf-8"))
    del known["crc32"]
    row.write_text(json.dumps(known | values, indent=2), encoding="utf-8")
    return row


@pytest.mark.parametrize("of", ["office", "pots", "beds", "made"])
def test_each_row_replays_without_its_run(of: str, tmp_path: Path) -> None:
    """At both resolutions, in domains of one's own as well: under each condition of a sweep."""
    config = {
        "office": lambda: _written(tmp_path, OFFICE),
        "pots": lambda: Own(tmp_path, GREENHOUSE).write(**POTS),
        "beds": lambda: Own(tmp_path, RAKED, ROWS).write(**BEDS),
        "made": lambda: _written(tmp_path, MADE),
    }[of]()
    records = _played(config, tmp_path / "run")
    assert len({record["cell"] for record in records}) == 2
    assert of in ("beds", "made") or any(record["exogenous"] for record in records)
    for number, record in enumerate(records):
        file = tmp_path / f"{number}.json"
        asked = ("replay", tmp_path / "run", "--trial", record["trial"], "--row", "-o", file)
        assert _call(*asked).exit_code == 0
    shutil.rmtree(tmp_path / "run")
    config.unlink()
    for number, record in enumerate(records):
        told = _call("replay", tmp_path / f"{number}.json")
        assert told.exit_code == 0, told.output
        assert record["trial"] in told.stdout
        assert told.stdout.splitlines()[-1] == "as recorded"
        assert told.stderr == ""


def test_a_line_replays_with_its_texts_beside_it(tmp_path: Path) -> None:
    _played(Own(tmp_path, RAKED, ROWS).write(**BEDS), tmp_path / "run")
    line, texts = tmp_path / "away" / "line.json", ("own.al", "own.fine")
    line.write_text(_last(tmp_path / "run"), encoding="utf-8")
    assert "own.al" in _refused("replay", line)
    for name in texts:
        shutil.copy(tmp_path / "run" / name, line.parent)
    assert _call("replay", line).exit_code == 0
    with (line.parent / "own.fine").open("a", encoding="utf-8") as file:
        file.write("% another text\n")
    refused = _refused("replay", line)
    assert "own.fine" in refused
    assert json.loads(line.read_text("utf-8"))["origin"]["refinement_sha256"] in refused


def test_a_domain_of_a_packaged_name_is_the_one_that_was_played(tmp_path: Path) -> None:
    """The hash decides between the packaged text and the one beside the row."""
    (tmp_path / "own").mkdir()
    (tmp_path / "own" / "office.al").write_text(GREENHOUSE, encoding="utf-8")
    config = Own(tmp_path, GREENHOUSE).write(**POTS, domain=str(tmp_path / "own" / "office.al"))
    _played(config, tmp_path / "run")
    line = tmp_path / "away" / "line.json"
    line.write_text(_last(tmp_path / "run"), encoding="utf-8")
    assert "office.al" in _refused("replay", line)
    shutil.copy(tmp_path / "own" / "office.al", line.parent)
    assert _call("replay", line).exit_code == 0


@pytest.mark.parametrize("form", ["ndjson", "json"])
def test_a_row_of_the_table_replays(form: str, pots: Path, tmp_path: Path) -> None:
    table, file = pl.read_parquet(export(pots)[0]).tail(1), tmp_path / "away" / "row.json"
    table.write_ndjson(file) if form == "ndjson" else table.write_json(file)
    shutil.copy(pots / "own.al", file.parent)
    told = _call("replay", file)
    assert told.exit_code == 0, told.output
    assert told.stdout.splitlines()[-1] == "as recorded"


def test_what_differs_from_the_row_is_said(row: Path) -> None:
    told = _call("replay", _changed(row, action_count=77))
    assert told.exit_code == 1
    assert "action_count was 77" in told.stdout.splitlines()[-1]


def test_other_versions_are_said_in_one_line(row: Path) -> None:
    origin = json.loads(row.read_text("utf-8"))["origin"]
    told = _call("replay", _changed(row, origin=origin | {"versions": {"clingo": "0.1"}}))
    assert told.exit_code == 0, told.output
    (line,) = told.stderr.splitlines()
    assert "clingo 0.1" in line
    assert told.stdout.splitlines()[-1] == "as recorded"


def test_a_row_of_an_older_version_replays_without_origin(row: Path) -> None:
    known = json.loads(row.read_text("utf-8"))
    del known["origin"], known["crc32"], known["version"]
    row.write_text(json.dumps(known), encoding="utf-8")
    assert _call("replay", row).exit_code == 0


def test_a_row_has_the_programs_of_its_decisions(pots: Path, row: Path) -> None:
    trial = json.loads(row.read_text("utf-8"))["trial"]
    wanted = ("--step", "1", "--program")
    alone, in_run = _call("replay", row, *wanted), _call("replay", pots, "--trial", trial, *wanted)
    assert alone.exit_code == 0, alone.output
    assert alone.stdout == in_run.stdout


def _mistakes(row: Path) -> dict[str, bytes]:
    """What is no row of a trial, by what the line about it has to say."""
    text = row.read_bytes()
    known = json.loads(text)
    del known["crc32"]
    places = {"domain": "../own"}
    return {
        "crc32": text.replace(b'"seed":', b'"seed":1'),
        "2 lines": text * 2,
        "malformed": b"row of a trial",
        "mapping": b"[]",
        "version": json.dumps(known | {"version": 99}).encode(),
        "`trial`": json.dumps({"seed": 1}).encode(),
        "`condition`": json.dumps(known | {"condition": None}).encode(),
        "'../own'": json.dumps(known | {"condition": known["condition"] | places}).encode(),
        "nobody_has_it": json.dumps(known | {"robot": "nobody_has_it:Robot"}).encode(),
        "own.al": json.dumps(known | {"texts": {"domain": RAKED}}).encode(),
    }


def test_each_mistake_of_a_row_costs_one_line(row: Path) -> None:
    for said, text in _mistakes(row).items():
        row.write_bytes(text)
        refused = _refused("replay", row)
        assert said in refused
        assert said == "own.al" or str(row) in refused


def test_a_text_that_was_changed_since_is_not_written_into_a_row(pots: Path) -> None:
    record = json.loads(_last(pots))
    with (pots / "own.al").open("a", encoding="utf-8") as file:
        file.write("% another text\n")
    refused = _refused("replay", pots, "--trial", record["trial"], "--row")
    assert "own.al" in refused
    assert record["origin"]["domain_sha256"] in refused


@pytest.mark.parametrize(
    ("options", "said"),
    [
        (["row.json", "--trial", "a"], "--trial"),
        (["row.json", "--row"], "--row"),
        (["row.json", "-o", "out"], "--output"),
        (["row.json", "--program"], "--program"),
        (["../run", "--row"], "--trial"),
        (["nowhere.json"], "nowhere.json"),
    ],
)
def test_options_that_do_not_go_together_are_refused(
    options: list[str], said: str, tmp_path: Path
) -> None:
    (tmp_path / "run").mkdir()
    Path("row.json").write_text("{}", encoding="utf-8")
    assert said in _refused("replay", *options)


ROBOT = """\
from agents.traditional.robot import TraditionalRobot


class Potter(TraditionalRobot):
    pass
"""


def test_a_robot_of_ones_own_is_found_beside_the_row(tmp_path: Path) -> None:
    config = Own(tmp_path, GREENHOUSE).write(**POTS | {"robots": ["potter_of_a_row:Potter"]})
    (config.parent / "potter_of_a_row.py").write_text(ROBOT, encoding="utf-8")
    sys.path.append(str(config.parent))
    _played(config, tmp_path / "run")
    line = tmp_path / "away" / "line.json"
    line.write_text(_last(tmp_path / "run"), encoding="utf-8")
    shutil.copy(tmp_path / "run" / "own.al", line.parent)
    missing = _testbed("replay", line)
    assert missing.returncode == 2
    (told,) = missing.stderr.splitlines()
    assert "potter_of_a_row" in told
    shutil.copy(config.parent / "potter_of_a_row.py", line.parent)
    assert _testbed("replay", line).returncode == 0


def _testbed(*arguments: str | Path) -> subprocess.CompletedProcess[str]:
    """A process of its own, which has imported nothing yet."""
    command = [sys.executable, "-P", "-m", "testbed", *map(str, arguments)]
    environment = {**os.environ, "PYTHONPATH": str(ROOT)}
    return subprocess.run(command, check=False, capture_output=True, text=True, env=environment)
