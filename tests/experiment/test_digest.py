"""The digest of a run's results: what it depends on, and what it does not."""

import json
from pathlib import Path

import pytest
from typer.testing import CliRunner

from testbed.cli import app
from testbed.experiment.digest import digest
from testbed.experiment.record import (
    TIMES,
    Activity,
    At,
    Attempt,
    Explained,
    FineCounts,
    Occurrence,
    Report,
    TrialRecord,
)
from testbed.experiment.store import read_records
from testbed.protocol import Contradiction
from tests.experiment.samples import a_record

ONE, OTHER = a_record("a"), a_record("b", outcome="gave_up")


def test_the_order_of_the_records_makes_no_difference() -> None:
    assert digest([ONE, OTHER]) == digest([OTHER, ONE])


def _with(**changed: object) -> str:
    """The digest of both records, the first with other values."""
    return digest([a_record(**({"trial": "a"} | changed)), OTHER])  # type: ignore[arg-type]


RESULTS: dict[str, object] = {
    "seed": 2,
    "scenario": "2",
    "level": "L1",
    "robot": "traditional",
    "initial": ["loc(book1,kitchen)"],
    "goal": ["-loc(book1,library)"],
    "outcome": "gave_up",
    "actions": [Attempt(1, "act", False)],
    "exogenous": [Occurrence(1, "event", observed=False)],
    "explanations": [Explained(1, [At(0, "event")], [])],
    "mental": [At(1, "start(1)")],
    "plans": 2,
    "activities": [Activity(1, 1, ["act"])],
    "execution_units": 3,
}
REST: dict[str, object] = {
    "trial": "c",
    "pair": "another",
    "domain": "another",
    "reason": "why",
    "steps": 7,
    "minimal_actions": 9,
    "minimal_units": 5,
    "oracle_units": 4,
    "reports": [Report(2, 1, "event", true=False)],
    "fine": FineCounts(plans=1, tests=2, infer_time_s=1.0),
    "in_reach": True,
} | dict.fromkeys((name for name in TrialRecord.__struct_fields__ if name.endswith(TIMES)), 3.5)


@pytest.mark.parametrize("field", RESULTS)
def test_a_result_makes_a_difference(field: str) -> None:
    assert _with(**{field: RESULTS[field]}) != _with()


@pytest.mark.parametrize("field", REST)
def test_ids_prose_times_and_statistics_make_none(field: str) -> None:
    assert _with(**{field: REST[field]}) == _with()


def _explained(**more: object) -> str:
    return _with(explanations=[Explained(3, [At(2, "event")], ["loc(a,b)"], **more)])  # type: ignore[arg-type]


def test_of_an_explanation_only_what_it_assumes_counts() -> None:
    whys = [Contradiction(step=3, observed="loc(a,b)", believed="loc(a,c)")]
    assert _explained(contradictions=whys, alternatives=2, more_alternatives=True) == _explained()
    assert _explained(distrusted=[At(1, "event")]) != _explained()


def test_of_an_activity_only_its_start_and_its_plan_count() -> None:
    ended = _with(activities=[Activity(7, 1, ["act"], stop=3, futile_at=4, reason="why")])
    assert ended == _with(activities=[Activity(1, 1, ["act"])])
    assert ended != _with(activities=[Activity(1, 2, ["act"])])
    assert ended != _with(activities=[Activity(1, 1, ["another"])])


def test_a_missing_and_a_doubled_record_make_one() -> None:
    assert len({digest([]), digest([ONE]), digest([ONE, ONE]), digest([ONE, OTHER])}) == 4


def _says(*arguments: str) -> str:
    """The digest that a command prints."""
    done = CliRunner().invoke(app, arguments)
    assert done.exit_code == 0, done.output
    (line,) = [line for line in done.output.splitlines() if line.startswith("digest of ")]
    assert " 2 trials" in line
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


def test_a_trial_that_the_clock_cut_off_is_left_out() -> None:
    cut_off = a_record("c", deadline=True, outcome="step_limit")
    assert digest([ONE, cut_off, OTHER]) == digest([ONE, OTHER])
