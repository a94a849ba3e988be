"""However a run ends, it is bounded, says how to go on, and leaves no process behind."""

import json
import os
import signal
import subprocess
import sys
import time
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path

import pytest

pytestmark = pytest.mark.load

TESTBED = [sys.executable, "-m", "testbed"]
HELD = [sys.executable, "-m", "tests.held"]
RUN = ["run", "quickstart", "scenarios=[1,2]", "--out", "run"]
PATIENCE_S = 600.0
ROBOTS_WAIT = """
import os, pathlib, sys, time
if "robot" in sys.orig_argv:
    pathlib.Path(f"started-{os.getpid()}").touch()
    while True:
        time.sleep(0.01)
"""
"""What every Python of a run begins with: its robots never get further."""
ROBOTS_END = """
import os, sys
if "robot" in sys.orig_argv:
    print("no legs", file=sys.stderr, flush=True)
    os._exit(3)
"""
NO_SESSIONS = """
import zenoh
def refuse(*_):
    raise zenoh.ZError("no room for shared memory")
zenoh.open = refuse
"""


@pytest.fixture(autouse=True)
def _elsewhere(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Commands run in a folder of the test's own, and import from there and this checkout."""
    root = str(Path(__file__).parents[2])
    monkeypatch.setenv("PYTHONPATH", os.pathsep.join([str(tmp_path), root]))
    monkeypatch.chdir(tmp_path)


def _begin_with(program: str) -> None:
    Path("sitecustomize.py").write_text(program, encoding="utf-8")


@contextmanager
def _running(*command: str) -> Iterator[subprocess.Popen[str]]:
    process = subprocess.Popen(
        command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, start_new_session=True
    )
    try:
        yield process
    finally:
        process.kill()
        process.communicate()


def _is_there(process: int) -> bool:
    """Whether a process runs; one that only waits for its parent to notice its end does not."""
    state = subprocess.run(
        ["ps", "-o", "stat=", "-p", str(process)], check=False, capture_output=True, text=True
    ).stdout
    return bool(state.strip()) and not state.startswith("Z")


def _gone(processes: Sequence[int]) -> bool:
    """Whether they all end, sooner or later."""
    end = time.monotonic() + PATIENCE_S
    while any(map(_is_there, processes)):
        if time.monotonic() > end:
            return False
        time.sleep(0.05)
    return True


@pytest.mark.parametrize("signals", [[signal.SIGINT] * 3, [signal.SIGHUP], [signal.SIGKILL]])
def test_robots_that_start_end_with_their_driver(signals: list[signal.Signals]) -> None:
    _begin_with(ROBOTS_WAIT)
    with _running(*TESTBED, *RUN, "--workers", "2") as driver:
        while len(started := list(Path().glob("started-*"))) < 2:
            assert driver.poll() is None, driver.communicate()
            time.sleep(0.01)
        for number in signals:
            os.killpg(driver.pid, number)
        output, errors = driver.communicate(timeout=PATIENCE_S)
    robots = [int(path.name.partition("-")[2]) for path in started]
    try:
        assert _gone(robots)
    finally:
        for robot in filter(_is_there, robots):
            os.kill(robot, signal.SIGKILL)
    if signal.SIGKILL not in signals:
        assert (driver.returncode, "Traceback" in errors) == (130, False), errors
        assert "--resume" in output


def test_a_second_interrupt_ends_a_driver_that_cannot_hear_it() -> None:
    Path("stuck").touch()
    with _running(*HELD, *RUN) as driver:
        while not Path("run/provenance.json").exists():
            assert driver.poll() is None, driver.communicate()
            time.sleep(0.01)
        driver.send_signal(signal.SIGINT)
        assert driver.stderr is not None
        # At once, though nobody is there to hear the interrupt.
        assert any("stopping" in line for line in iter(driver.stderr.readline, ""))
        while driver.poll() is None:
            driver.send_signal(signal.SIGINT)
            time.sleep(0.1)
        errors = driver.communicate()[1]
    assert driver.returncode == 130
    assert "--resume" in errors.splitlines()[-1]


def test_a_run_that_is_to_outlive_its_terminal_does() -> None:
    Path("hold").write_text("1")
    with _running("nohup", *HELD, *RUN, "robots=[tests.held:Held]", "link=inprocess") as driver:
        trials = Path("run/trials.jsonl")
        while not (trials.exists() and trials.read_bytes()):
            assert driver.poll() is None, driver.communicate()
            time.sleep(0.01)
        os.killpg(driver.pid, signal.SIGHUP)
        Path("hold").unlink()
        driver.communicate(timeout=PATIENCE_S)
    assert driver.returncode == 0


@pytest.mark.parametrize("workers", ["1", "2"])
@pytest.mark.parametrize(("program", "reason"), [(NO_SESSIONS, "no room"), (ROBOTS_END, "no legs")])
def test_a_worker_that_cannot_play_is_told_once_and_ends_the_run(
    program: str, reason: str, workers: str
) -> None:
    _begin_with(program)
    with _running(*TESTBED, *RUN, "--quiet", "--workers", workers) as driver:
        output, errors = driver.communicate(timeout=PATIENCE_S)
    assert (driver.returncode, output) == (2, "")
    assert len(errors.splitlines()) == 1
    assert reason in errors
    assert Path("run/trials.jsonl").read_bytes() == b""
    assert json.loads(Path("run/provenance.json").read_text(encoding="utf-8"))["exit"] == 2
