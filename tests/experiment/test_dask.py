"""Trials on Dask are those of the local pool, whatever becomes of the workers."""

import shutil
import sys
from collections.abc import Iterator
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import dask
import pytest
from distributed import Client

from benchmarks.clusters import ROOT, scheduler, until, worker
from testbed.cli.loading import load
from testbed.config import ExperimentConfig
from testbed.experiment import WorkerError, run
from testbed.experiment.digest import digest, logical
from testbed.experiment.store import read_records
from testbed.registry import PATH_VARIABLE
from tests.pots import CARRIED, write_pots

pytestmark = pytest.mark.load

ROBOTS = """\
import os
import signal
from pathlib import Path

from testbed.protocol import Capabilities

from helping_carriers import carried


class Carrier:
    capabilities = Capabilities()

    def begin(self, task):
        pass

    def act(self, percept):
        return carried(percept)


class Mortal(Carrier):
    '''Takes its process with it, as often as there are lives.'''

    def begin(self, task):
        lives = [*Path("lives").glob("*")]
        if "stands(rose,floor)" in task.initial and lives:
            lives[0].unlink()
            os.kill(os.getpid(), signal.SIGKILL)
"""
ADVERSARY = """\
class Calm:
    sees = ()

    def __init__(self, game, options): ...
    def reset(self, seed): ...
    def act(self, view):
        return "none"
"""


@pytest.fixture(autouse=True)
def pots(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A configuration, and robots and adversaries beside it."""
    monkeypatch.setenv(PATH_VARIABLE, "")
    monkeypatch.setattr(sys, "path", list(sys.path))
    monkeypatch.chdir(tmp_path)
    own = {"carriers_at_work": ROBOTS, "helping_carriers": CARRIED, "calm_weather": ADVERSARY}
    for name in own:
        monkeypatch.delitem(sys.modules, name, raising=False)
    return write_pots(tmp_path / "beside", **own)


def _played(config: ExperimentConfig, folder: str, workers: int | None) -> list[dict[str, object]]:
    run(config, Path(folder), workers)
    return [logical(record) for record in read_records(Path(folder))]


def test_the_same_trials_come_out_of_any_number_of_workers(pots: Path) -> None:
    here = _played(load(pots), "here", workers=0)
    assert len(here) == 36
    for runner, workers in [("local", 1), ("local", 2), ("dask", 1), ("dask", 2), ("dask", 4)]:
        folder = f"{runner}-{workers}"
        assert _played(load(pots, [f"runner={runner}"]), folder, workers) == here
        assert digest(read_records(Path(folder))) == digest(read_records(Path("here")))


@pytest.fixture
def address(tmp_path: Path) -> Iterator[str]:
    """Of a scheduler without workers."""
    with scheduler(tmp_path / "scheduler") as own:
        yield own.address


def test_domains_robots_and_adversaries_travel(pots: Path, tmp_path: Path, address: str) -> None:
    own = ["robots=[carriers_at_work:Carrier]", "adversary.strategy=calm_weather:Calm"]
    config = load(
        pots, [*own, "runner=dask", f"scheduler={address}", "link=zenoh", "adversary.rate=null"]
    )
    with ThreadPoolExecutor() as threads, Client(address) as client:
        going = threads.submit(run, config, tmp_path / "run")
        until(lambda: going.done() or client.run_on_scheduler(_waits))
        pots.parent.rename(tmp_path / "elsewhere")
        with worker(address, tmp_path / "worker"):
            status = going.result()
    assert (status.failed, status.done) == (0, 18)
    assert all(record.achieved for record in read_records(tmp_path / "run"))


def _waits(dask_scheduler: object) -> bool:
    return bool(dask_scheduler.worker_plugins and dask_scheduler.unrunnable)  # type: ignore[attr-defined]


def test_a_worker_with_other_code_is_told_and_plays_nothing(
    pots: Path, tmp_path: Path, address: str, capfd: pytest.CaptureFixture[str]
) -> None:
    for package in ("agents", "asp", "testbed"):
        shutil.copytree(ROOT / package, tmp_path / "other" / package)
    with (tmp_path / "other/agents/traditional/robot.py").open("a") as source:
        source.write("# is another one\n")
    config = load(pots, ["runner=dask", f"scheduler={address}"])
    with Client(address) as client, worker(address, tmp_path / "unlike", path=[tmp_path / "other"]):
        client.wait_for_workers(1)
        with pytest.raises(WorkerError, match="source of agents"):
            run(config, tmp_path / "run")
        (unlike,) = client.scheduler_info()["workers"]
        with worker(address, tmp_path / "worker"):
            client.wait_for_workers(2)
            run(config, tmp_path / "run", resume=True)
    here = _played(load(pots), "here", workers=0)
    assert [logical(record) for record in read_records(tmp_path / "run")] == here
    (line,) = {line for line in capfd.readouterr().err.splitlines() if unlike in line}
    assert "source of agents" in line


def test_a_worker_that_dies_costs_an_attempt(pots: Path) -> None:
    """One of a cluster of one worker, in whose place another one starts."""
    Path("lives").mkdir()
    config = load(pots, ["robots=[carriers_at_work:Mortal]", "runner=dask"])
    expected = _played(config, "here", workers=0)
    Path("lives/1").touch()
    assert _played(config, "dask", workers=1) == expected
    assert not [*Path("lives").iterdir()]


def test_a_trial_that_workers_die_of_is_lost_alone(pots: Path) -> None:
    Path("lives").mkdir()
    three = ["seed=2", "limit=3"]  # of which the second is the one, and the third was to be next
    config = load(pots, ["robots=[carriers_at_work:Mortal]", "runner=dask", *three])
    for life in range(100):
        Path(f"lives/{life}").touch()
    with dask.config.set({"distributed.scheduler.allowed-failures": 0}):
        status = run(config, Path("run"), workers=1)
    second = [own.outcome == "error" for own in read_records(Path("run"))]
    assert second == ["stands(rose,floor)" in own.initial for own in read_records(Path("run"))]
    assert (second, status.failed) == ([False, True, False], 1)
    assert [own.cause for own in read_records(Path("run"))] == [None, "infrastructure", None]
