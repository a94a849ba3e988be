"""A run is watched from another process, while it is held where the test wants it."""

import json
import os
import pty
import signal
import subprocess
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from threading import Thread

import pytest
from typer.testing import CliRunner

from benchmarks.clusters import ROOT, started, until
from benchmarks.own import Own
from testbed.cli import app
from testbed.config import load_config
from testbed.experiment import run
from testbed.experiment.errors import StoreError
from testbed.experiment.lock import is_written, locked
from testbed.experiment.shard import Shard
from tests.experiment.gardens import GARDEN, ROWS
from tests.pots import write_pots

WATCH = ["-m", "testbed", "watch", "run", "--every", "0.02"]
ROBOTS = """\
from testbed.protocol import Capabilities, Decision, Trace


class Idle:
    capabilities = Capabilities()

    def begin(self, task):
        pass

    def act(self, percept):
        return Decision(
            trial=percept.trial,
            step=percept.step,
            action="finish",
            believes_goal=True,
            trace=Trace(reason="\\x1b[31mis done"),
        )


class Broken(Idle):
    def act(self, percept):
        raise RuntimeError("broken")
"""


@pytest.fixture(autouse=True)
def _elsewhere(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Commands run in a folder of the test's own, with a configuration and robots in it."""
    monkeypatch.chdir(tmp_path)
    write_pots(tmp_path)
    (tmp_path / "idle_robots.py").write_text(ROBOTS, encoding="utf-8")


@contextmanager
def _playing(begun: int) -> Iterator[subprocess.Popen[str]]:
    """A run of nine trials, whose robot may begin so many of them until `hold` is gone."""
    _hold(begun)
    held = ["-m", "tests.held", "run", "pots.yaml", "robots=[tests.held:Held]", "repeats=1"]
    with started(*held, "--out", "run", "--workers", "1", cwd=Path.cwd()) as driver:
        yield driver


def _hold(begun: int) -> None:
    Path("hold.part").write_text(str(begun))
    os.replace("hold.part", "hold")


def _on_record() -> int:
    trials = Path("run/trials.jsonl")
    return trials.read_bytes().count(b"\n") if trials.exists() else 0


def _records() -> list[dict[str, object]]:
    return [json.loads(line) for line in Path("run/trials.jsonl").read_bytes().splitlines()]


def _lines_until(watching: subprocess.Popen[str], part: str) -> list[str]:
    """What is said up to a line that has this part."""
    assert watching.stdout is not None
    said = []
    for line in watching.stdout:
        said.append(line)
        if part in line:
            return said
    raise AssertionError(f"{part!r} is not in {said}")


def _rest(watching: subprocess.Popen[str]) -> list[str]:
    """What is said until it ends, as it should."""
    assert watching.stdout is not None
    said = list(watching.stdout)
    assert watching.wait() == 0
    return said


def _once(*options: str) -> list[str]:
    done = CliRunner().invoke(app, ["watch", "run", "--once", *options])
    assert done.exit_code == 0, done.stderr
    return done.stdout.splitlines()


def _told(lines: list[str]) -> str:
    """The id of the trial whose story is told."""
    (head,) = [line for line in lines if line.startswith("trial ")]
    return head.split()[1].rstrip(":")


def test_a_run_is_watched_from_before_its_beginning_to_its_end() -> None:
    with started(*WATCH, cwd=Path.cwd()) as watching:
        _lines_until(watching, "waiting")
        with _playing(0) as driver:
            _lines_until(watching, "0 of 9 ")
            _hold(2)  # within its third trial: two are on record, and the newer one is told
            until(lambda: _on_record() == 2, driver)
            said = _lines_until(watching, "2 of 9 ") + _lines_until(watching, "outcome ")
            newer = str(_records()[1]["trial"])
            assert any(line.startswith(f"trial {newer}") for line in said)
            assert watching.poll() is None
            look = _once()
            assert (look[0].partition(" trials")[0], _told(look)) == ("2 of 9", newer)
            Path("hold").unlink()
            assert driver.wait() == 0
        rest = _rest(watching)
    last = str(_records()[-1]["trial"])
    assert any(line.startswith("9 of 9 ") for line in rest)
    assert any(line.startswith(f"trial {last}") for line in rest)
    assert "\x1b" not in "".join(rest)


def test_who_watches_may_leave_and_a_run_that_is_killed_is_over() -> None:
    with _playing(1) as driver, started(*WATCH, cwd=Path.cwd()) as watching:
        _lines_until(watching, "1 of 9 ")
        watching.send_signal(signal.SIGINT)
        _rest(watching)
        assert watching.stderr is not None
        assert watching.stderr.read() == ""
        assert driver.poll() is None
        driver.kill()
        driver.wait()
    done = CliRunner().invoke(app, ["watch", "run"])
    assert done.exit_code == 0
    assert "--resume" in done.stdout.splitlines()[-1]


def test_robots_and_failures_are_chosen() -> None:
    config = load_config("pots.yaml", ["robots=[idle_robots:Idle,intentional]", "repeats=1"])
    sys.path.insert(0, str(Path.cwd()))
    try:
        run(config, Path("run"), workers=0)
    finally:
        sys.path.remove(str(Path.cwd()))
    records = _records()
    newest = {own: [r for r in records if r["robot"] == own][-1] for own in config.robots}
    assert _told(_once()) == records[-1]["trial"]
    for robot, record in newest.items():
        assert _told(_once("--robot", robot)) == record["trial"]
    wrong = [own["trial"] for own in records if not own["achieved"]]
    assert wrong
    assert wrong[-1] == _told(_once("--failures"))
    told = _once("--robot", "idle_robots:Idle")
    assert "\x1b" not in "".join(told)
    outcomes = next(line for line in told if line.strip().startswith("idle_robots:Idle"))
    achieved = sum(own["achieved"] is True for own in records if own["robot"] == config.robots[0])
    assert f"{achieved} achieved" in outcomes
    assert f"{9 - achieved} false finish" in outcomes


@pytest.mark.parametrize("refinement", ["", ROWS])
def test_a_story_is_told_as_a_replay_tells_it(tmp_path: Path, refinement: str) -> None:
    own = Own(tmp_path, GARDEN.replace("OTHER", "rake"), refinement)
    file = own.write(goal=["stands(spade,south)"], limit=1, robots=["intentional"])
    run(load_config(file), Path("run"), workers=0)
    told = _once()
    replayed = CliRunner().invoke(app, ["replay", "run", "--trial", _told(told)])
    assert replayed.exit_code == 0
    assert _steps(told) == _steps(replayed.stdout.splitlines())


def _steps(lines: list[str]) -> list[str]:
    (outcome,) = [number for number, line in enumerate(lines) if line.startswith("outcome ")]
    steps = lines[lines.index("step 1") : outcome]
    assert "step 2" in steps
    return steps


def test_a_part_of_a_run_is_as_large_as_the_part() -> None:
    run(load_config("pots.yaml"), Path("run"), workers=0, shard=Shard(4, 4))
    assert _on_record() == 8
    assert _once()[0].startswith("8 of 8 ")


def test_a_terminal_is_drawn_on() -> None:
    run(load_config("pots.yaml", ["repeats=1", "limit=2"]), Path("run"), workers=0)
    ours, theirs = pty.openpty()
    environment = {**os.environ, "PYTHONPATH": str(ROOT), "TERM": "xterm", "COLUMNS": "100"}
    with subprocess.Popen([sys.executable, *WATCH], stdout=theirs, env=environment) as watching:
        os.close(theirs)
        said = b""
        while part := _read(ours):
            said += part
        assert watching.wait() == 0
    os.close(ours)
    text = said.decode()
    assert "\x1b[" in text
    assert f"trial {_records()[-1]['trial']}" in text
    assert "belief" in text


def _read(terminal: int) -> bytes:
    try:
        return os.read(terminal, 4096)
    except OSError:  # how a terminal ends
        return b""


@pytest.mark.parametrize("options", [[], ["--once"]])
def test_what_is_no_run_is_refused(options: list[str]) -> None:
    Path("full").mkdir()
    Path("full/notes.txt").touch()
    for wrong in ("full", "pots.yaml", *(["nowhere"] if options else [])):
        done = CliRunner().invoke(app, ["watch", wrong, *options])
        (line,) = done.stderr.splitlines()
        assert (done.exit_code, wrong in line) == (2, True)


def test_a_robot_that_the_run_does_not_have_is_refused() -> None:
    run(load_config("pots.yaml", ["repeats=1", "limit=1"]), Path("run"), workers=0)
    done = CliRunner().invoke(app, ["watch", "run", "--robot", "intentionl"])
    (line,) = done.stderr.splitlines()
    assert (done.exit_code, "'intentional'" in line) == (2, True)


def test_who_watches_keeps_no_run_from_beginning() -> None:
    """A run that begins just when somebody asks whether one goes on waits until that is told."""
    stop = False

    def ask() -> None:
        while not stop:
            is_written(Path("run"))

    Path("run").mkdir()
    asking = [Thread(target=ask) for _ in range(2)]
    for thread in asking:
        thread.start()
    try:
        for _ in range(5000):
            with locked(Path("run")):
                pass
        with locked(Path("run")):
            assert is_written(Path("run"))
            with pytest.raises(StoreError), locked(Path("run")):
                pass
    finally:
        stop = True
        for thread in asking:
            thread.join()
    assert not is_written(Path("run"))
