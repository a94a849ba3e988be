"""However a run on Dask ends before its time, it says so in one line, and goes on from there."""

import os
import signal
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import psutil
import pytest
from distributed import Client, Scheduler
from typer.testing import CliRunner

from benchmarks.clusters import PATIENCE_S, Process, scheduler, started, until, worker
from benchmarks.killing import whole_lines
from testbed.cli import app
from testbed.cli.loading import load
from testbed.experiment import run
from testbed.experiment.digest import logical
from testbed.experiment.store import read_records
from testbed.registry import PATH_VARIABLE
from tests.pots import CARRIED, HOLDING, write_pots

pytestmark = pytest.mark.load

RECORDS, HOLD = Path("run/trials.jsonl"), Path("hold")
ROBOT = "robots=[holding_carriers:Held]"


@pytest.fixture(autouse=True)
def pots(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[Path]:
    """A configuration, and a robot that each process stops before its fourth trial."""
    monkeypatch.setenv(PATH_VARIABLE, "")
    monkeypatch.setattr(sys, "path", list(sys.path))
    monkeypatch.chdir(tmp_path)
    own = {
        "holding_carriers": HOLDING.format(hold=str(HOLD.absolute())),
        "helping_carriers": CARRIED,
    }
    for name in own:
        monkeypatch.delitem(sys.modules, name, raising=False)
    HOLD.touch()
    yield write_pots(tmp_path / "beside", **own)
    HOLD.unlink(missing_ok=True)


@contextmanager
def _driver(pots: Path, *overrides: str) -> Iterator[Process]:
    """A run with its first records, all the others of which wait."""
    command = ("-m", "testbed", "run", str(pots), ROBOT, "runner=dask", "--out", "run")
    with started(*command, *overrides, cwd=Path.cwd()) as driver:
        until(lambda: RECORDS.exists() and RECORDS.read_bytes(), driver)
        yield driver


def _goes_on(pots: Path, *overrides: str) -> None:
    """Let the run go on as it was, to what one gives that nothing disturbed."""
    kept = whole_lines(RECORDS)
    assert 1 <= kept.count(b"\n") < 18
    HOLD.unlink()
    given = ["run", str(pots), ROBOT, "runner=dask", *overrides]
    done = CliRunner().invoke(app, [*given, "--out", "run", "--resume"])
    assert done.exit_code == 0, done.output
    assert RECORDS.read_bytes().startswith(kept)
    run(load(pots, [ROBOT]), Path("here"), workers=0)
    assert _logical("run") == _logical("here")


def _logical(folder: str) -> list[str]:
    return sorted(str(logical(record)) for record in read_records(Path(folder)))


def _runs(process: psutil.Process) -> bool:
    return process.is_running() and process.status() != psutil.STATUS_ZOMBIE


@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGKILL])
def test_workers_of_a_run_end_with_it(pots: Path, number: signal.Signals) -> None:
    with _driver(pots, "--workers", "2") as driver:
        processes = psutil.Process(driver.pid).children(recursive=True)
        if number == signal.SIGINT:  # as a terminal does
            os.killpg(driver.pid, number)
        else:
            driver.kill()
        output, errors = driver.communicate(timeout=PATIENCE_S)
    assert len(processes) >= 2
    until(lambda: not any(map(_runs, processes)))
    if number == signal.SIGINT:
        assert (driver.returncode, "Traceback" in errors) == (130, False), errors
        assert "--resume" in output
    _goes_on(pots, "runner=local", "--workers", "1")


def test_an_interrupted_run_leaves_nothing_to_a_cluster(pots: Path, tmp_path: Path) -> None:
    with scheduler(tmp_path / "scheduler") as own, worker(own.address, tmp_path / "worker"):
        address = f"scheduler={own.address}"
        with _driver(pots, address) as driver:
            os.killpg(driver.pid, signal.SIGINT)
            output, errors = driver.communicate(timeout=PATIENCE_S)
        assert (driver.returncode, "Traceback" in errors) == (130, False), errors
        assert "--resume" in output
        with Client(own.address) as client:
            assert client.run_on_scheduler(_left) == []
        _goes_on(pots, address)
        until(lambda: not [*tmp_path.glob("worker/**/testbed-*")])


def _left(dask_scheduler: Scheduler) -> list[str]:
    plugins = (name for name in dask_scheduler.worker_plugins if name.startswith("testbed-"))
    return [*map(str, dask_scheduler.tasks), *plugins]


def test_a_run_whose_scheduler_is_lost_goes_on_with_another(pots: Path, tmp_path: Path) -> None:
    with (
        scheduler(tmp_path / "lost") as own,
        worker(own.address, tmp_path / "worker"),
        _driver(pots, f"scheduler={own.address}", "--quiet") as driver,
    ):
        own.process.kill()
        output, errors = driver.communicate(timeout=PATIENCE_S)
    assert (driver.returncode, output) == (2, "")
    (line,) = errors.splitlines()
    assert own.address in line
    assert "--resume" in line
    with scheduler(tmp_path / "scheduler") as other, worker(other.address, tmp_path / "worker"):
        _goes_on(pots, f"scheduler={other.address}")
