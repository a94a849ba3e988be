"""What a worker of Dask has for one run: the files of the run, and a player that is opened once.

A worker that is like the driver offers a resource of the run's name, which the run's tasks ask for:
an unlike one, whenever it joins, gets none of them. One task of a run has the resource at a time.
"""

import shutil
from collections.abc import Mapping, Sequence
from contextlib import ExitStack
from itertools import takewhile
from pathlib import Path
from threading import Lock
from typing import ClassVar

from distributed import Status, Worker, WorkerPlugin, get_worker

from testbed.experiment.adversaries import ADVERSARIES
from testbed.experiment.errors import WorkerError
from testbed.experiment.fingerprint import difference
from testbed.experiment.luggage import MODULES, Luggage
from testbed.experiment.recorder import Result
from testbed.experiment.robots import ROBOTS
from testbed.experiment.specs import TrialSpec
from testbed.experiment.worker import OpenPlayer, Play, not_ready, why_not_ready
from testbed.experiment.worker_pool import play_here
from testbed.registry import search_last, search_no_more


class TrialPlayer(WorkerPlugin):
    """Plays the trials of the run `name` in a worker, with one robot process for all of them.

    A worker whose fingerprint is not `wanted`, or that has other modules in the place of those that
    are sent, says so under the topic `name`, and is given no trial.
    """

    _turn: ClassVar = Lock()  # modules are the process's: of several runs one plays at a time
    _present: ClassVar["TrialPlayer | None"] = None

    def __init__(
        self, name: str, open_player: OpenPlayer, luggage: Luggage, wanted: Mapping[str, str]
    ) -> None:
        self.name, self._open_player = name, open_player
        self._luggage, self._wanted = luggage, wanted
        self._folder = Path()
        self._stack = ExitStack()
        self._play: Play | None = None
        self._over = False

    async def setup(self, worker: Worker) -> None:
        """Called of each worker of the cluster, and of those that join later."""
        why = difference(self._wanted)
        if why is not None:
            worker.log_event(self.name, unlike(worker.address, why))
            return
        self._folder = Path(worker.local_directory).resolve() / self.name
        self._luggage.unpack(self._folder)
        await worker.set_resources(**{self.name: 1})
        # Tasks that wait for the resource are given out when a worker begins to run.
        worker.status = Status.paused
        worker.status = Status.running

    def teardown(self, worker: Worker) -> None:
        """Called when the run, or the worker, ends; a trial that is played then is played out."""
        del worker
        self._over = True
        if self._turn.acquire(blocking=False):
            try:
                self._close()
            finally:
                self._turn.release()

    def play(self, specs: Sequence[TrialSpec]) -> list[Result]:
        """The results of trials; not of all of them where the run ends meanwhile.

        Raises:
            WorkerError: when no trial can be played.
        """
        try:
            with self._turn:
                play = self._opened()
                located = (self._luggage.located(spec, self._folder) for spec in specs)
                wanted = takewhile(lambda _: not self._over, located)
                return [result for _, result in play_here(wanted, play)]
        finally:
            if self._over:
                with self._turn:
                    self._close()

    def _opened(self) -> Play:
        if self._play is None:
            if TrialPlayer._present is not None:
                TrialPlayer._present._close()
            TrialPlayer._present = self
            try:
                self._play = self._open()
            except Exception as error:
                self._close()
                raise not_ready(why_not_ready(error)) from None
        return self._play

    def _open(self) -> Play:
        modules = self._folder / MODULES
        search_last(modules)
        self._stack.callback(_forget, modules)
        other = self._luggage.displaced()
        if other is not None:
            raise WorkerError(f"{get_worker().address}: {other}")
        return self._stack.enter_context(self._open_player())

    def _close(self) -> None:
        self._stack.close()
        self._play = None
        if TrialPlayer._present is self:
            TrialPlayer._present = None
        if self._over:
            shutil.rmtree(self._folder, ignore_errors=True)


def unlike(worker: str, why: str) -> str:
    """The line that says of a worker why it plays nothing."""
    return f"worker {worker} is not used: it has {why}"


def _forget(modules: Path) -> None:
    search_no_more(modules)
    ROBOTS.forget()
    ADVERSARIES.forget()


def play_batch(run: str, specs: Sequence[TrialSpec]) -> list[Result]:
    """A task: the results of trials of a run, played by the player that this worker has for it."""
    player = get_worker().plugins[run]
    assert isinstance(player, TrialPlayer)
    return player.play(specs)
