"""The digest of a run's results: what it depends on, and what it does not."""

import json
from pathlib import Path

import pytest
from typer.testing import CliRunner

from testbed.cli import app
from testbed.experiment.digest import digest
from testbed.experiment.record import TIMES
from testbed.experiment.store import read_records
from tests.experiment.samples import a_record

ONE, OTHER = a_record("a"), a_record("b", achieved=False)


def test_the_order_of_the_records_makes_no_difference() -> None:
    assert digest([ONE, OTHER]) == digest([OTHER, ONE])


@pytest.mark.parametrize("time", [name for name in TIMES if name != "infer_time_s"])
def test_times_make_no_difference(time: str) -> None:
    assert digest([a_record("a", **{time: 3.5}), OTHER]) == digest([ONE, OTHER])


@pytest.mark.parametrize(
    "changed",
    [{"achieved": False}, {"steps": 1}, {"reason": "why"}, {"minimal_units": 5}, {"trial": "c"}],
)
def test_any_result_makes_one(changed: dict[str, object]) -> None:
    assert digest([a_record(**({"trial": "a"} | changed)), OTHER]) != digest([ONE, OTHER])  # type: ignore[arg-type]


def test_a_missing_and_a_doubled_record_make_one() -> None:
    assert len({digest([]), digest([ONE]), digest([ONE, ONE]), digest([ONE, OTHER])}) == 4


def _says(*arguments: str) -> str:
    """The digest that a command prints."""
    done = CliRunner().invoke(app, arguments)
    assert done.exit_code == 0, done.output
    (line,) = [line for line in done.output.splitlines() if line.startswith("digest of ")]
    assert line.startswith("digest of 2 trials, times aside: ")
    return line.split()[-1]


def test_a_run_and_its_report_tell_the_digest_and_keep_it(tmp_path: Path) -> None:
    run = ("run", "quickstart", "scenarios=[2]", "link=inprocess", "--out", str(tmp_path / "run"))
    told = _says(*run)
    assert told == digest(read_records(tmp_path / "run"))
    summary = tmp_path / "run" / "summary.json"
    kept = json.loads(summary.read_text(encoding="utf-8"))
    assert kept["digest"] == told
    assert told in (tmp_path / "run" / "report.html").read_text(encoding="utf-8")
    summary.unlink()
    assert _says("report", str(tmp_path / "run")) == told
    assert json.loads(summary.read_text(encoding="utf-8")) == kept
