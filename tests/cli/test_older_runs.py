"""Run folders that are older than a key of the configuration, or of records."""

import json
from pathlib import Path

import pytest
import yaml
from typer.testing import CliRunner

from testbed.cli import app

QUIET = ("link=inprocess", "--workers", "1", "--quiet")


def _done(*arguments: str) -> int:
    return CliRunner().invoke(app, arguments).exit_code


def _records(folder: str) -> dict[str, str]:
    """The lines of a run by their trials."""
    lines = Path(folder, "trials.jsonl").read_text(encoding="utf-8").splitlines()
    return {json.loads(line)["trial"]: line for line in lines}


@pytest.fixture
def older(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> str:
    """A run from before `relevance` and `origin`, of which one of two trials was played."""
    monkeypatch.chdir(tmp_path)
    asked = ("run", "office", "scenarios=[1]", "limit=1", "relevance=published", "--out", "run")
    assert _done(*asked, *QUIET) == 0
    stored, records = Path("run/config.yaml"), Path("run/trials.jsonl")
    keys = yaml.safe_load(stored.read_text(encoding="utf-8"))
    assert keys.pop("relevance") == "published"
    stored.write_text(yaml.safe_dump(keys), encoding="utf-8")
    first = json.loads(next(iter(_records("run").values())))
    older = {key: own for key, own in first.items() if key not in ("origin", "version", "crc32")}
    assert len(older) == len(first) - 3
    records.write_text(json.dumps(older) + "\n", encoding="utf-8")
    return "run"


def test_one_without_relevance_goes_on_as_it_was_played(older: str) -> None:
    """Robots heeded what the released controller did, and no id said so."""
    (played,) = _records(older)
    resumed = ("run", f"{older}/config.yaml", "--out", older, "--resume", "--quiet")
    assert _done(*resumed) == 0
    assert len(_records(older)) == 2
    assert played in _records(older)
    assert [_done("replay", older, "--trial", trial) for trial in _records(older)] == [0, 0]
    assert _done("report", older) == 0
