"""The budget of a decision never strikes in the published studies: a part of it suffices by far."""

import json
from pathlib import Path

import pytest
from typer.testing import CliRunner

from testbed.cli import app
from testbed.config import load_config
from testbed.experiment.store import read_records

STUDIES = {"table1": [], "levels": ["levels=[L1,L2]"]}
BUDGETS = ("conflicts", "ground_rules", "expansions")
PART = 20


def _played(study: str, folder: Path, limits: list[str]) -> str:
    """The digest of a pair of each scenario or level; its worker has nothing prepared yet."""
    given = [*STUDIES[study], "limit=1", "link=inprocess", "limits.decision_s=null", *limits]
    arguments = ["run", study, *given, "--workers", "1", "--out", str(folder), "--quiet"]
    done = CliRunner().invoke(app, arguments)
    assert done.exit_code == 0, done.output
    return str(json.loads((folder / "summary.json").read_text(encoding="utf-8"))["digest"])


@pytest.mark.parametrize("study", STUDIES)
def test_a_twentieth_of_the_default_budget_changes_nothing(study: str, tmp_path: Path) -> None:
    limits = load_config(study).limits
    part = [f"limits.{name}={getattr(limits, name) // PART}" for name in BUDGETS]
    unbounded = [f"limits.{name}=null" for name in BUDGETS]
    digest = _played(study, tmp_path / "part", part)
    assert digest == _played(study, tmp_path / "unbounded", unbounded)
    played = read_records(tmp_path / "part")
    assert "unproved" not in {own.minimal for record in played for own in record.explanations}
