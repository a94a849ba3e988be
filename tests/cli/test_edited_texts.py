"""A domain or map that is edited in a run folder is told before anything is made of the run."""

import json
from pathlib import Path

import pytest
from typer.testing import CliRunner, Result

from benchmarks.own import Own
from testbed.cli import app
from tests.experiment.gardens import GARDEN, ROWS

BEDS = {"goal": ["stands(spade,south)", "-carries(tom,spade)"], "robots": ["intentional"]}
EDITED = {"own.al": "domain_sha256", "own.fine": "refinement_sha256"}
"""Files of a run folder, with the key of a record's origin that has their hash."""


def _call(*arguments: str | Path) -> Result:
    return CliRunner().invoke(app, [str(part) for part in arguments])


@pytest.fixture
def beds(tmp_path: Path) -> Path:
    """A run in a domain and a map of its own."""
    config = Own(tmp_path, GARDEN.replace("OTHER", "rake"), ROWS).write(**BEDS)
    done = _call("run", config, "--out", tmp_path / "run", "--workers", "1", "--quiet")
    assert done.exit_code == 0, done.output
    return tmp_path / "run"


@pytest.mark.parametrize("name", EDITED)
def test_an_edited_text_is_refused_until_it_is_back(name: str, beds: Path) -> None:
    record = json.loads((beds / "trials.jsonl").read_text("utf-8").splitlines()[0])
    commands = [
        ("report", beds),
        ("replay", beds),
        ("replay", beds, "--trial", record["trial"]),
        ("run", beds / "config.yaml", "--out", beds, "--resume", "--quiet"),
    ]
    before = (beds / name).read_text("utf-8")
    (beds / name).write_text(before + "% another text\n", encoding="utf-8")
    for command in commands:
        refused = _call(*command)
        assert refused.exit_code == 2, refused.output
        (line,) = [own for own in refused.stderr.splitlines() if not own.startswith("preparing")]
        assert str(beds / name) in line
        assert record["origin"][EDITED[name]] in line
    (beds / name).write_text(before, encoding="utf-8")
    for command in commands:
        assert _call(*command).exit_code == 0


def test_records_that_do_not_say_what_they_were_played_in_are_read(beds: Path) -> None:
    """Those of older testbeds, and of a trial that failed before its domain was read."""
    (line,) = (beds / "trials.jsonl").read_text("utf-8").splitlines()
    record = json.loads(line)
    del record["crc32"]
    with (beds / "own.al").open("a", encoding="utf-8") as file:
        file.write("% another text\n")
    for origin in (None, record["origin"] | dict.fromkeys(EDITED.values())):
        text = json.dumps(record | {"origin": origin}) + "\n"
        (beds / "trials.jsonl").write_text(text, encoding="utf-8")
        assert _call("replay", beds).exit_code == 0
