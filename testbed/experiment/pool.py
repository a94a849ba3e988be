"""Play trials in this process, or on several worker processes that live across trials.

`concurrent.futures` gives up the whole pool when one worker dies; here that costs the one trial.
Workers are spawned: a forked process with an open zenoh session hangs. The trials of a pair are
played by one worker, one right after the other, so that their times are of the same process.
"""

from __future__ import annotations

import os
import signal
from collections import deque
from collections.abc import Callable, Generator, Iterator, Sequence
from contextlib import AbstractContextManager, suppress
from itertools import groupby
from multiprocessing import get_context
from multiprocessing.connection import Connection, wait
from multiprocessing.context import SpawnProcess

from testbed.experiment.interrupts import SIGNALS, interrupts_later
from testbed.experiment.specs import TrialSpec
from testbed.experiment.trial import Result, lost_worker

Play = Callable[[TrialSpec], Result]
OpenPlayer = Callable[[], AbstractContextManager[Play]]

AHEAD = 4096  # trials that may wait, finished, for an earlier one: what bounds the memory
EXIT_S = 10.0
WORTH = 50  # trials for which another process is worth its start


def play_all(
    specs: Sequence[TrialSpec], workers: int, open_player: OpenPlayer
) -> Generator[tuple[int, Result], None, None]:
    """Results with their position in `specs`, as they come.

    `open_player` gives what plays one trial after the other; it is called once a process, and
    must be picklable when there are several `workers`.
    """
    if workers == 1:
        with open_player() as play:
            yield from ((position, play(spec)) for position, spec in enumerate(specs))
        return
    crew = _Crew(specs, open_player)
    try:
        yield from crew.work(min(workers, len(specs)))
    except BaseException:  # also where the caller stops listening
        crew.dismiss(at_once=True)
        raise
    crew.dismiss(at_once=False)


def workers_for(trials: int) -> int:
    """One process a core, but as many only as have `WORTH` trials each; one at least."""
    return max(1, min(_cores(), trials // WORTH))


def _cores() -> int:
    """Those that this process may use, where the system says it."""
    if hasattr(os, "sched_getaffinity"):
        return len(os.sched_getaffinity(0))
    return os.cpu_count() or 1


class _Worker:
    """A spawned process, the pipe to it, and positions: of the trial that it has, of its next."""

    def __init__(self, open_player: OpenPlayer) -> None:
        context = get_context("spawn")
        self.pipe, far_end = context.Pipe()
        self.process: SpawnProcess = context.Process(target=_serve, args=(far_end, open_player))
        with interrupts_later():
            self.process.start()
        far_end.close()
        self.position: int | None = None
        self.next: deque[int] = deque()

    def end(self, at_once: bool) -> int | None:
        """End the process and return its exit code."""
        self.pipe.close()
        if at_once:
            self.process.kill()
        self.process.join(EXIT_S)
        if self.process.exitcode is None:
            self.process.kill()
            self.process.join()
        return self.process.exitcode


class _Crew:
    """The workers of one run and the trials not yet given to them."""

    def __init__(self, specs: Sequence[TrialSpec], open_player: OpenPlayer) -> None:
        self._specs = specs
        self._open_player = open_player
        self._pairs = deque(_by_pair(specs))
        self._workers: list[_Worker] = []

    def work(self, size: int) -> Iterator[tuple[int, Result]]:
        for _ in range(size):
            self._workers.append(_Worker(self._open_player))
        while True:
            self._hand_out()
            busy = {w.pipe: w for w in self._workers if w.position is not None}
            if not busy:
                return
            for pipe in wait(list(busy)):
                assert isinstance(pipe, Connection)
                yield self._collect(busy[pipe])

    def dismiss(self, at_once: bool) -> None:
        for worker in self._workers:
            if at_once:
                worker.process.kill()
            worker.pipe.close()
        for worker in self._workers:
            worker.end(at_once)

    def _hand_out(self) -> None:
        for worker in self._workers:
            if worker.position is None:
                self._give(worker)

    def _give(self, worker: _Worker) -> None:
        """The next of its pair, or the first of the next pair."""
        if not worker.next and self._pairs and self._pairs[0][0] < self._horizon():
            worker.next.extend(self._pairs.popleft())
        if worker.next:
            worker.position = worker.next.popleft()
            with suppress(OSError):  # a dead worker shows when its answer is collected
                worker.pipe.send(self._specs[worker.position])

    def _horizon(self) -> int:
        under_way = [w.position for w in self._workers if w.position is not None]
        return min(under_way, default=len(self._specs)) + AHEAD

    def _collect(self, worker: _Worker) -> tuple[int, Result]:
        assert worker.position is not None
        position, worker.position = worker.position, None
        try:
            return position, worker.pipe.recv()
        except (EOFError, OSError):
            code = worker.end(at_once=True)
            heir = self._workers[self._workers.index(worker)] = _Worker(self._open_player)
            heir.next = worker.next
            return position, lost_worker(self._specs[position], code)


def _by_pair(specs: Sequence[TrialSpec]) -> Iterator[list[int]]:
    """The positions of each pair, which stand one after the other."""
    for _, own in groupby(range(len(specs)), lambda position: specs[position].pair):
        yield list(own)


def _serve(pipe: Connection, open_player: OpenPlayer) -> None:
    """A worker's life: until the pipe closes, which it also does when the driver dies."""
    for number in SIGNALS:  # where all of a group get one, it is for the driver to handle
        signal.signal(number, signal.SIG_IGN)
    with suppress(EOFError, OSError), open_player() as play:
        while True:
            pipe.send(play(pipe.recv()))
