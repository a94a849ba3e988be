"""Trials played by worker processes, one after the other, which live across them.

`concurrent.futures` gives up the whole pool when one worker dies; here that costs an attempt at
one trial. The trials of a pair are played by one worker, one right after the other, so that their
times are of the same process.
"""

from collections import deque
from collections.abc import Generator, Iterable, Iterator, Sequence
from itertools import groupby
from multiprocessing.connection import Connection, wait

from testbed.experiment.origin import cores
from testbed.experiment.recorder import Result, lost_worker
from testbed.experiment.specs import TrialSpec
from testbed.experiment.worker import OpenPlayer, Play, Worker

Results = Generator[tuple[int, Result], None, None]
"""With their positions in the plan."""

AHEAD = 4096  # trials that may wait, finished, for an earlier one: what bounds the memory
WORTH = 50  # trials for which another process is worth its start


def play_all(specs: Sequence[TrialSpec], workers: int, open_player: OpenPlayer) -> Results:
    """Results with their position in `specs`, as they come.

    `open_player` gives what plays one trial after the other; it is called once a process, and
    must be picklable unless `workers` is 0: then all are played in this process, which cannot be
    interrupted at any moment. A trial that infrastructure fails is played a second time.

    Raises:
        WorkerError: when a worker cannot play, or ends before it has played.
    """
    if workers == 0:
        with open_player() as play:
            yield from play_here(specs, play)
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
    return max(1, min(cores(), trials // WORTH))


def play_here(specs: Iterable[TrialSpec], play: Play) -> Iterator[tuple[int, Result]]:
    """As `play_all`, in this process."""
    failed: dict[int, str] = {}
    for position, spec in enumerate(specs):
        result = play(spec)
        while _is_retried(position, result, failed):
            result = play(spec)
        yield position, result


def _is_retried(position: int, result: Result, failed: dict[int, str]) -> bool:
    """Whether infrastructure failed the trial for the first time: it gets one more try.

    `failed` has the reasons of trials that are played again; a result after all has that reason.
    """
    record = result.record
    if record.cause == "infrastructure" and position not in failed:
        failed[position] = record.reason or ""
        return True
    if position in failed:
        record.retried = [failed.pop(position)]
    return False


class _Crew:
    """The workers of one run and the trials not yet given to them."""

    def __init__(self, specs: Sequence[TrialSpec], open_player: OpenPlayer) -> None:
        self._specs = specs
        self._open_player = open_player
        pairs = groupby(range(len(specs)), lambda position: specs[position].pair)
        self._pairs = deque(list(positions) for _, positions in pairs)
        self._workers: list[Worker] = []
        self._failed: dict[int, str] = {}

    def work(self, size: int) -> Iterator[tuple[int, Result]]:
        for _ in range(size):
            self._workers.append(Worker(self._open_player))
            self._workers[-1].start()
        while awaited := self._awaited():
            for pipe in wait(list(awaited)):
                assert isinstance(pipe, Connection)
                yield from self._hear(awaited[pipe])

    def dismiss(self, at_once: bool) -> None:
        for worker in self._workers:
            worker.leave(at_once)
        for worker in self._workers:
            worker.end(at_once)

    def _awaited(self) -> dict[Connection, Worker]:
        """Those that play now, or will as soon as they are ready."""
        for worker in self._workers:
            if worker.ready and worker.position is None:
                self._give(worker)
        return {
            worker.pipe: worker
            for worker in self._workers
            if worker.position is not None or (not worker.ready and (worker.next or self._pairs))
        }

    def _give(self, worker: Worker) -> None:
        """The next of its pair, or the first of the next pair."""
        if not worker.next and self._pairs and self._pairs[0][0] < self._horizon():
            worker.next.extend(self._pairs.popleft())
        if worker.next:
            position = worker.next.popleft()
            worker.play(position, self._specs[position])

    def _horizon(self) -> int:
        """The first position that is too far ahead of what others are still to play."""
        ahead = [
            worker.next[0] if worker.position is None else worker.position
            for worker in self._workers
            if worker.next or worker.position is not None
        ]
        return min(ahead, default=len(self._specs)) + AHEAD

    def _hear(self, worker: Worker) -> Iterator[tuple[int, Result]]:
        position, was_ready = worker.position, worker.ready
        try:
            result = worker.receive()
        except EOFError:
            assert position is not None
            how = f"worker process ended with exit code {worker.end(at_once=True)}"
            result = lost_worker(self._specs[position], how)
            worker = self._replaced(worker)
        if not was_ready:
            return
        assert position is not None
        assert result is not None
        worker.position = None
        if _is_retried(position, result, self._failed):
            worker.next.appendleft(position)
        else:
            yield position, result

    def _replaced(self, dead: Worker) -> Worker:
        """Another worker for what the dead one was to play next."""
        heir = self._workers[self._workers.index(dead)] = Worker(self._open_player)
        heir.next = dead.next
        heir.start()
        return heir
