"""A cluster of Dask of which parts are killed while it plays, and started again."""

from contextlib import ExitStack
from pathlib import Path
from random import Random
from threading import Lock
from typing import Self

from distributed import Client

from benchmarks.clusters import ROOT, Process, scheduler, until, worker
from benchmarks.counting import BEGUN

OTHER_VERSION = "0.0.0"
COUNTING = ("--preload", "benchmarks.counting")


class FragileCluster:
    """A scheduler and its workers, in folders inside `folder`.

    Which worker is killed is drawn with a seed. All of it may be called by several threads.
    """

    def __init__(self, folder: Path, workers: int, seed: int = 1) -> None:
        self._folder, self._size = folder, workers
        self._random, self._lock, self._stack = Random(seed), Lock(), ExitStack()
        self._started = 0
        self._workers: dict[Path, Process] = {}  # by their folders
        self.workers_killed, self.schedulers_killed = 0, 0

    def __enter__(self) -> Self:
        self._begin()
        return self

    def __exit__(self, *_: object) -> None:
        with self._lock:
            self._stack.close()

    def _begin(self) -> None:
        self._scheduler = self._stack.enter_context(scheduler(self._new_folder("scheduler")))
        self._workers = {}
        for _ in range(self._size):
            self._new_worker()

    def _new_folder(self, name: str) -> Path:
        self._started += 1
        return self._folder / f"{name}-{self._started}"

    def _new_worker(self) -> None:
        folder = self._new_folder("worker")
        own = worker(self.address, folder, *COUNTING)
        self._workers[folder] = self._stack.enter_context(own)

    @property
    def address(self) -> str:
        """Of the scheduler that there is now."""
        return self._scheduler.address

    def kill_worker(self) -> None:
        """Kill (SIGKILL) one of the workers that have begun to play, whatever it does now.

        Another one is started in its place. None is killed where most have not begun yet: on a
        busy machine one after the other would be, each in its first trial.
        """
        with self._lock:
            playing = [folder for folder in self._workers if (folder / BEGUN).exists()]
            if 2 * len(playing) >= self._size:
                self._workers.pop(self._random.choice(playing)).kill()
                self.workers_killed += 1
                self._new_worker()

    def restart_scheduler(self) -> None:
        """Kill (SIGKILL) the scheduler, and start another one with workers of its own.

        Those of the first end by themselves.
        """
        with self._lock:
            self._scheduler.process.kill()
            self.schedulers_killed += 1
            self._begin()

    def add_unlike(self) -> None:
        """Let a worker with another version of this testbed join."""
        other = self._folder / "other"
        facts = other / f"intention_testbed-{OTHER_VERSION}.dist-info/METADATA"
        facts.parent.mkdir(parents=True)
        lines = ("Metadata-Version: 2.1", "Name: intention-testbed", f"Version: {OTHER_VERSION}")
        facts.write_text("\n".join(lines), encoding="utf-8")
        with self._lock, Client(self.address, set_as_default=False) as client:
            there = len(client.scheduler_info()["workers"])
            unlike = worker(self.address, self._new_folder("unlike"), *COUNTING, path=[other, ROOT])
            own = self._stack.enter_context(unlike)
            until(lambda: len(client.scheduler_info()["workers"]) > there, own)

    def begun(self, name: str = "worker") -> list[str]:
        """The ids of the trials that workers began, one for each time."""
        files = sorted(self._folder.glob(f"{name}-*/{BEGUN}"))
        return [trial for file in files for trial in file.read_text("utf-8").split()]
