"""Failed trials are played again where that is asked for, and a run has one driver at a time."""

import json
import subprocess
import sys
import time
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import pytest

HELD = [sys.executable, "-m", "tests.held"]
RUN = [
    "run",
    "quickstart",
    "scenarios=[1,2]",
    "robots=[tests.held:Held]",
    "link=inprocess",
    "--out",
    "run",
]
AGAIN = [*RUN, "--resume", "--retry-failed"]
TRIALS = Path("run/trials.jsonl")


@pytest.fixture(autouse=True)
def _elsewhere(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Commands run in a folder of the test's own, and import from this checkout."""
    monkeypatch.setenv("PYTHONPATH", str(Path(__file__).parents[2]))
    monkeypatch.chdir(tmp_path)


def _code(*arguments: str) -> tuple[int, str]:
    done = subprocess.run([*HELD, *arguments], check=False, capture_output=True, text=True)
    return done.returncode, done.stderr


@contextmanager
def _running(*arguments: str) -> Iterator[subprocess.Popen[bytes]]:
    """A command that is killed in the end."""
    with subprocess.Popen([*HELD, *arguments], stderr=subprocess.DEVNULL) as driver:
        try:
            yield driver
        finally:
            driver.kill()


def _records() -> list[dict[str, Any]]:
    return [json.loads(line) for line in TRIALS.read_bytes().splitlines()]


def _digest() -> str:
    return str(json.loads(Path("run/summary.json").read_text(encoding="utf-8"))["digest"])


@pytest.fixture
def failed() -> bytes:
    """The records of a run whose trials all failed, for a reason that is gone now."""
    Path("broken").touch()
    assert _code(*RUN)[0] == 1
    Path("broken").unlink()
    assert [record["outcome"] for record in _records()] == ["robot_lost"] * 2
    return TRIALS.read_bytes()


def test_failed_trials_are_played_again_where_that_is_asked_for(failed: bytes) -> None:
    ids = [record["trial"] for record in _records()]
    assert _code(*RUN, "--resume")[0] == 1
    assert TRIALS.read_bytes() == failed
    assert _code(*AGAIN)[0] == 0
    records = _records()
    assert [record["trial"] for record in records] == ids
    assert [record["outcome"] for record in records] == ["achieved"] * 2
    assert [len(record["retried"]) for record in records] == [1, 1]
    assert all("broken" in record["retried"][0] for record in records)
    assert list(Path("run/errors").iterdir()) == []
    digest = _digest()
    assert _code(*RUN[:-1], "undisturbed")[0] == 0
    undisturbed = json.loads(Path("undisturbed/summary.json").read_text(encoding="utf-8"))
    assert undisturbed["digest"] == digest


def test_a_retry_that_is_killed_loses_nothing(failed: bytes) -> None:
    Path("hold").write_text("1")
    retried = Path("run/retries.jsonl")
    with _running(*AGAIN, "--quiet") as driver:
        while not (retried.exists() and retried.read_bytes().endswith(b"\n")):
            assert driver.poll() is None
            time.sleep(0.01)
    assert TRIALS.read_bytes() == failed
    first = json.loads(retried.read_bytes())
    retried.write_bytes(retried.read_bytes() + b'{"trial":')
    Path("hold").unlink()
    assert _code(*RUN, "--resume")[0] == 1, "one that failed is left"
    assert [record["outcome"] for record in _records()] == ["achieved", "robot_lost"]
    assert _records()[0] == first
    assert _code(*AGAIN)[0] == 0
    assert [record["outcome"] for record in _records()] == ["achieved"] * 2
    assert _records()[0] == first


def test_a_retry_goes_on_with_a_run_only() -> None:
    code, errors = _code(*RUN, "--quiet", "--retry-failed")
    assert (code, len(errors.splitlines())) == (2, 1)
    assert "--retry-failed" in errors
    assert not TRIALS.exists()


def test_a_run_has_one_driver_from_its_first_moment_on() -> None:
    """Also while that one still plans, and has written its configuration and nothing else."""
    Path("stuck").touch()
    with _running(*RUN) as driver:
        while not Path("run/provenance.json").exists():
            assert driver.poll() is None
            time.sleep(0.01)
        before = Path("run/config.yaml").read_bytes()
        for other in ([], ["seed=7"], ["--resume"]):
            code, errors = _code(*RUN, "--quiet", *other)
            assert (code, len(errors.splitlines())) == (2, 1)
            assert "run" in errors
        assert Path("run/config.yaml").read_bytes() == before
        assert not TRIALS.exists()


@pytest.mark.parametrize("again", [[], ["--resume"]])
def test_the_terminal_says_why_the_first_trial_failed(again: list[str]) -> None:
    """In one line that is bounded and steers nothing; also of a trial that failed before."""
    Path("broken").write_text("no oil\x1b[31m" + "x" * 5_000, encoding="utf-8")
    for more in ([], again) if again else ([],):
        command = [*HELD, *RUN, *more]
        done = subprocess.run(command, check=False, capture_output=True, text=True)
    assert done.returncode == 1
    (line,) = (line for line in done.stdout.splitlines() if "no oil" in line)
    assert line.startswith("2 trials")
    assert "\\x1b[31m" in line
    assert len(line) < 500
