"""A cluster of Dask of which parts are killed while it plays, and started again."""

from collections.abc import Iterator
from contextlib import ExitStack, contextmanager
from pathlib import Path
from random import Random
from threading import Lock
from typing import Self

from benchmarks.clusters import ROOT, Process, scheduler, until, worker
from benchmarks.counting import BEGUN, STANDS, STOP

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
                self._kill(self._random.choice(playing))

    @contextmanager
    def killing_in_trial(self) -> Iterator[None]:
        """Kill (SIGKILL) a worker in the middle of a trial that it begins from now on.

        At the end of the block one is waited for. Workers that begin others stand still until then.
        """
        with self._lock:
            stops = [folder / STOP for folder in self._workers]
            for stop in stops:
                stop.touch()
            yield
            until(self._standing)
            self._kill(self._random.choice(self._standing()))
            for stop in stops:
                stop.unlink(missing_ok=True)
                stop.with_name(STANDS).unlink(missing_ok=True)

    def _standing(self) -> list[Path]:
        return [folder for folder in self._workers if (folder / STANDS).exists()]

    def _kill(self, folder: Path) -> None:
        """Kill the worker of a folder, and start another one in its place."""
        self._workers.pop(folder).kill()
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

    def add_unlike(self) -> Process:
        """Start a worker with another version of this testbed; it need not have joined yet."""
        other = self._folder / "other"
        facts = other / f"intention_testbed-{OTHER_VERSION}.dist-info/METADATA"
        facts.parent.mkdir(parents=True)
        lines = ("Metadata-Version: 2.1", "Name: intention-testbed", f"Version: {OTHER_VERSION}")
        facts.write_text("\n".join(lines), encoding="utf-8")
        with self._lock:
            unlike = worker(self.address, self._new_folder("unlike"), *COUNTING, path=[other, ROOT])
            return self._stack.enter_context(unlike)

    def begun(self, name: str = "worker") -> list[str]:
        """The ids of the trials that workers began, one for each time."""
        files = sorted(self._folder.glob(f"{name}-*/{BEGUN}"))
        return [trial for file in files for trial in file.read_text("utf-8").split()]
