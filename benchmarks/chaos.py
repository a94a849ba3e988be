"""A run on a cluster whose workers, scheduler and driver are killed, and the same undisturbed.

It ends with the records of the undisturbed one: each trial once, whatever was killed.
"""

import subprocess
import sys
import tempfile
import time
from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from pathlib import Path
from threading import Event, Thread
from typing import Literal

from benchmarks import fragile_driver, killing
from benchmarks.clusters import until
from benchmarks.fragile_cluster import OTHER_VERSION, FragileCluster
from benchmarks.sheets import DisagreementError, Row, Sheet, gathered
from testbed.cli.loading import load
from testbed.experiment import runner
from testbed.experiment.digest import digest, logical
from testbed.experiment.plan import plan_trials
from testbed.experiment.record import FAILURES, TrialRecord
from testbed.experiment.store import read_records
from testbed.experiment.stories import StoryFile

RUN, CALM, ERRORS = "run", "calm", "errors"
Fault = Literal["worker", "unlike", "scheduler", "driver"]

PAIRS = {"small": 2, "full": 25}  # of each scenario of the published comparison
WORKERS = {"small": 2, "full": 4}
DRIVERS = {"small": fragile_driver.COMMAND, "full": killing.COMMAND}
EVERY_S = {"small": None, "full": 4.0}
FAULTS: Mapping[str, Mapping[int, Fault]] = {
    "small": {2: "worker", 6: "driver", 10: "unlike", 14: "scheduler", 18: "worker", 22: "driver"},
    "full": {50: "unlike", 100: "driver", 150: "scheduler", 200: "driver"},
}
"""What happens when so many records are written."""
UNTIMED = "limits.decision_s=null"  # on a busy machine, too, a decision is that of an idle one


def main(size: str) -> list[Sheet]:
    """Sheet `chaos`: what was killed, and what came of it. Raises DisagreementError."""
    own = Chaos(["table1", f"limit={PAIRS[size]}", UNTIMED], WORKERS[size], DRIVERS[size])
    every = EVERY_S[size]
    often = "" if every is None else f"; besides a worker every {every:g} s"
    faults = ", ".join(f"{fault} at {number}" for number, fault in FAULTS[size].items())
    return [
        Sheet(
            "chaos",
            f"Trials of Table 1 on Dask with {WORKERS[size]} workers, parts of it killed (SIGKILL)",
            gathered(
                {"count": name, "number": number}
                for name, number in own.play(FAULTS[size], every).items()
            ),
            (
                f"killed at so many records: {faults}{often};",
                "unlike is a worker of another version that joins;",
                "executions: trials that workers began; equal: digest, stories and records as of a",
                "run in this process that nothing disturbed, but for times and origin",
            ),
        )
    ]


class Chaos:
    """A configuration that is played by a cluster, and by this process."""

    def __init__(self, config: Sequence[str], workers: int, driver: Sequence[str]) -> None:
        self._config, self._workers, self._driver = config, workers, driver
        name, *overrides = config
        self._loaded = load(name, overrides)
        self._planned = [spec.trial for spec in plan_trials(self._loaded)]

    def play(self, faults: Mapping[int, Fault], every_s: float | None) -> Row:
        """Play with faults, and besides a worker killed every so many seconds.

        Raises:
            DisagreementError: where the records are not those of an undisturbed run.
        """
        with tempfile.TemporaryDirectory() as name:
            folder = Path(name)
            began = time.perf_counter()
            with FragileCluster(folder, self._workers) as cluster:
                with _killing(cluster, every_s):
                    sessions = self._sessions(cluster, folder, dict(faults))
                seconds = time.perf_counter() - began
                begun, unlike = cluster.begun(), cluster.begun("unlike")
            errors = (folder / ERRORS).read_text(encoding="utf-8")
            runner.run(self._loaded, folder / CALM, workers=0)
            return {
                "trials": len(self._planned),
                "executions": len(begun),
                "workers_killed": cluster.workers_killed,
                "schedulers_restarted": cluster.schedulers_killed,
                "drivers_killed": sessions["driver"],
                "resumed": sessions.total() - 1,
                "failed_and_retried": sessions["failed"],
                "unlike_named": errors.count(OTHER_VERSION),
                "unlike_executions": len(unlike),
                **self._compared(folder / RUN, folder / CALM),
                "seconds": seconds,
            }

    def _compared(self, run: Path, calm: Path) -> Row:
        records, expected = list(read_records(run)), list(read_records(calm))
        times = Counter(record.trial for record in records)
        lost = len(set(self._planned) - times.keys())
        equal = _logical(records) == _logical(expected) and digest(records) == digest(expected)
        stories = StoryFile(run).of(self._planned)
        if lost or not equal or stories != StoryFile(calm).of(self._planned):
            raise DisagreementError(f"{lost} of {len(self._planned)} trials lost, or others")
        duplicates = times.total() - len(times)
        return {"lost": lost, "duplicates": duplicates, "stories": len(stories), "equal": equal}

    def _sessions(
        self, cluster: FragileCluster, folder: Path, faults: dict[int, Fault]
    ) -> Counter[str]:
        """Run, and go on whenever the driver ends too early; how it ended, each time."""
        ended = Counter[str]()
        while not ended["done"]:
            retry = ["--retry-failed"] if ended["failed"] else []
            ended[self._session(cluster, folder, faults, retry)] += 1
            for record in read_records(folder / RUN):
                if record.outcome in FAILURES:
                    print(f"{record.trial}: {record.reason}", file=sys.stderr, flush=True)
            if ended["lost"] > cluster.schedulers_killed:
                raise DisagreementError((folder / ERRORS).read_text(encoding="utf-8"))
        return ended

    def _session(
        self, cluster: FragileCluster, folder: Path, faults: dict[int, Fault], more: Sequence[str]
    ) -> str:
        where = ["runner=dask", f"scheduler={cluster.address}", "--out", str(folder / RUN)]
        command = [*self._driver, ",".join(map(str, faults)), "run", *self._config, *where]
        errors = folder / ERRORS  # of all drivers
        with (
            errors.open("ab") as file,
            subprocess.Popen(
                [*command, "--resume", "--quiet", *more],
                stdin=subprocess.PIPE,
                stdout=subprocess.PIPE,
                stderr=file,
                text=True,
            ) as driver,
        ):
            assert driver.stdin is not None
            assert driver.stdout is not None
            for line in driver.stdout:
                if line.strip() != killing.HELD:
                    continue
                fault = faults.pop(min(faults))
                if fault == "driver":
                    driver.kill()
                    return fault
                with _injected(fault, cluster, errors):
                    driver.stdin.write("\n")
                    driver.stdin.flush()
        return {0: "done", 1: "failed", 2: "lost"}[driver.returncode]


def _logical(records: Sequence[TrialRecord]) -> dict[str, dict[str, object]]:
    return {record.trial: logical(record) for record in records}


@contextmanager
def _injected(fault: Fault, cluster: FragileCluster, errors: Path) -> Iterator[None]:
    """Let a fault happen; the driver, which is held, is to go on in the block."""
    if fault == "worker":
        with cluster.killing_in_trial():
            yield
        return
    if fault == "scheduler":
        cluster.restart_scheduler()
    else:
        unlike = cluster.add_unlike()
        until(lambda: OTHER_VERSION in errors.read_text(encoding="utf-8"), unlike)
    yield


@contextmanager
def _killing(cluster: FragileCluster, every_s: float | None) -> Iterator[None]:
    """Kill a worker every so many seconds, as long as the block lasts."""
    over = Event()

    def kill() -> None:
        while not over.wait(every_s):
            cluster.kill_worker()

    if every_s is None:
        yield
        return
    thread = Thread(target=kill)
    thread.start()
    try:
        yield
    finally:
        over.set()
        thread.join()
