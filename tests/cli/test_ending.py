"""How a run ends before its time, and what it says when it goes on: real processes and signals."""

import json
import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest
from typer.testing import CliRunner

from testbed.cli import app
from testbed.config import load_config
from testbed.experiment.plan import plan_trials
from testbed.experiment.record import TrialRecord
from testbed.experiment.shard import Shard
from testbed.experiment.store import TrialWriter

pytestmark = pytest.mark.load

HELD = [sys.executable, "-m", "tests.held"]
RUN = ["run", "quickstart", "scenarios=[2,4,5,6]", "robots=[tests.held:Held]", "link=inprocess"]


@pytest.fixture(autouse=True)
def _elsewhere(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Commands run in a folder of the test's own, and import from this checkout."""
    root = str(Path(__file__).parents[2])
    monkeypatch.setenv("PYTHONPATH", os.pathsep.join([root, os.environ.get("PYTHONPATH", "")]))
    monkeypatch.chdir(tmp_path)


def _ended(trials: int, workers: str, *signals: signal.Signals) -> tuple[int, str, str]:
    """Exit code and output of a run whose group gets these signals after so many trials."""
    Path("hold").write_text(str(trials))
    process = subprocess.Popen(
        [*HELD, *RUN, "--workers", workers, "--out", "run"],
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
        start_new_session=True,
    )
    records = Path("run/trials.jsonl")
    while process.poll() is None and not _reached(records, trials):
        time.sleep(0.01)
    for number in signals:
        os.killpg(process.pid, number)
    output, errors = process.communicate()
    Path("hold").unlink()
    return process.returncode, output, errors


def _reached(records: Path, trials: int) -> bool:
    return records.exists() and records.read_bytes().count(b"\n") >= trials


def _resumed() -> str:
    done = subprocess.run(
        [*HELD, *RUN, "--out", "run", "--resume"], check=False, capture_output=True, text=True
    )
    assert done.returncode == 0, done.stderr
    return done.stdout


@pytest.mark.parametrize("workers", ["1", "2"])
def test_a_run_that_is_terminated_ends_as_one_that_is_interrupted(workers: str) -> None:
    code, output, errors = _ended(1, workers, signal.SIGTERM, signal.SIGTERM)
    assert (code, "Traceback" in errors) == (130, False), errors
    lines = Path("run/trials.jsonl").read_text(encoding="utf-8").splitlines()
    outcomes = [json.loads(line)["outcome"] for line in lines]
    assert 1 <= len(outcomes) <= int(workers)
    assert set(outcomes) == {"achieved"}
    assert f"interrupted: {len(outcomes)} of 4 trials kept in run" in output
    assert "--resume" in output
    provenance = json.loads(Path("run/provenance.json").read_text(encoding="utf-8"))
    assert provenance["exit"] == 130
    assert provenance["start"] <= provenance["end"]
    summary = json.loads(Path("run/summary.json").read_text(encoding="utf-8"))
    assert (summary["trials"], summary["planned"]) == (len(outcomes), 4)
    assert f"{len(outcomes)} of 4 trials" in Path("run/report.html").read_text(encoding="utf-8")
    assert "incomplete" not in _resumed()


@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM, signal.SIGHUP])
def test_a_run_that_ends_before_its_first_trial_shows_no_table(number: signal.Signals) -> None:
    code, output, errors = _ended(0, "1", number)
    assert (code, "Traceback" in errors) == (130, False), errors
    assert output.splitlines() == [
        "interrupted: 0 of 4 trials kept in run",
        "to go on: testbed run run/config.yaml --out run --resume",
    ]
    summary = json.loads(Path("run/summary.json").read_text(encoding="utf-8"))
    assert (summary["trials"], summary["planned"]) == (0, 4)


def test_an_interrupt_while_trials_are_planned_is_put_on_record(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    def interrupted(_: object) -> None:
        os.kill(os.getpid(), signal.SIGTERM)

    monkeypatch.setattr("testbed.experiment.runner.plan_trials", interrupted)
    done = CliRunner().invoke(app, ["run", "quickstart", "--out", "run", "--quiet"])
    assert (done.exit_code, done.output) == (130, "")
    provenance = json.loads(Path("run/provenance.json").read_text(encoding="utf-8"))
    assert (provenance["exit"], provenance["workers"]) == (130, 0)
    assert signal.getsignal(signal.SIGTERM) == signal.SIG_DFL


def test_a_trial_on_record_is_counted_when_the_interrupt_comes_with_it(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    append = TrialWriter.append

    def interrupted(writer: TrialWriter, record: TrialRecord) -> None:
        append(writer, record)
        os.kill(os.getpid(), signal.SIGTERM)

    monkeypatch.setattr(TrialWriter, "append", interrupted)
    config = ["quickstart", "scenarios=[2,4,5,6]", "robots=[traditional]", "link=inprocess"]
    done = CliRunner().invoke(app, ["run", *config, "--workers", "1", "--out", "run"])
    assert done.exit_code == 130
    assert Path("run/trials.jsonl").read_bytes().count(b"\n") == 1
    assert "1 of 4 trials kept" in done.stdout


def test_a_part_that_is_interrupted_while_it_is_planned_counts_its_own_trials(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    def interrupted(_: object) -> None:
        os.kill(os.getpid(), signal.SIGTERM)

    config = ["quickstart", "scenarios=[2,4,5,6]"]
    own = len(Shard(1, 3).of(plan_trials(load_config(config[0], config[1:]))))
    monkeypatch.setattr("testbed.experiment.runner.plan_trials", interrupted)
    done = CliRunner().invoke(app, ["run", *config, "--out", "run", "--shard", "1/3"])
    assert done.exit_code == 130
    assert f" 0 of {own} trials " in done.stdout


def test_a_run_that_has_nothing_to_resume_says_so() -> None:
    said = "nothing to resume: a new run in run"
    assert _resumed().splitlines()[0] == said
    assert said not in _resumed()
