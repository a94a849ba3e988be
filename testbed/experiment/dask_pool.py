"""Trials played by the workers of a Dask cluster, or by one on this machine, as `play_all` does.

A task is about a second of trials, in whole pairs, so that the times of a pair are of one process.
What is Dask's is left to Dask: which worker plays a task, that one whose worker dies is played
again, where results are until they are fetched. A few tasks per worker are submitted at a time, so
that their size can follow the times of those before, and the driver's memory stays as it is.
"""

import secrets
from collections import deque
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import suppress
from itertools import groupby

from distributed import CancelledError, Client, Future, KilledWorker, as_completed

from testbed.experiment.dask_client import Scheduler, connected, dashboard_of
from testbed.experiment.dask_worker import TrialPlayer, play_batch, unlike
from testbed.experiment.errors import WorkerError
from testbed.experiment.fingerprint import difference, fingerprint
from testbed.experiment.luggage import Luggage
from testbed.experiment.recorder import Result, lost_worker
from testbed.experiment.specs import TrialSpec
from testbed.experiment.worker import OpenPlayer
from testbed.experiment.worker_pool import AHEAD, Results
from testbed.protocol import in_one_line
from testbed.text import warn

TASK_S = 1.0
TASKS_PER_WORKER = 2  # one that is played, and the next
RETRIES = 1  # of a task whose worker cannot open its player


def play_all(
    specs: Sequence[TrialSpec],
    cluster: int | Scheduler,
    open_player: OpenPlayer,
    shown_at: Callable[[str], None],
) -> Results:
    """Results with their position in `specs`, as they come.

    `cluster` is how many workers a cluster on this machine has, or the scheduler of another one.
    `open_player` is called once per worker, and must be picklable. `shown_at` is called with the
    address of the cluster's dashboard, where it has one.

    Raises:
        WorkerError: when a worker cannot play, none may, or the scheduler is not there, or no more.
    """
    run = f"testbed-{secrets.token_hex(4)}"
    where = "Dask" if isinstance(cluster, int) else cluster.address
    try:
        with connected(cluster) as client, _Crew(client, run, specs) as crew:
            if (dashboard := dashboard_of(client)) is not None:
                shown_at(dashboard)
            crew.prepare(open_player)
            yield from crew.work()
    except CancelledError:
        raise WorkerError(f"{where}: the scheduler was lost; --resume goes on") from None
    except (OSError, TimeoutError) as error:
        raise WorkerError(f"{where}: {in_one_line(error)}; --resume goes on") from None


class _Batches:
    """Positions of trials that are not yet submitted, given out by pairs."""

    def __init__(self, specs: Sequence[TrialSpec]) -> None:
        pairs = groupby(range(len(specs)), lambda position: specs[position].pair)
        self._pairs = deque(list(positions) for _, positions in pairs)
        self._trials, self._seconds = 0, 0.0

    def played(self, results: Sequence[Result]) -> None:
        """Learn how long trials take."""
        self._trials += len(results)
        self._seconds += sum(result.record.wall_time_s for result in results)

    def next(self, before: int) -> list[int]:
        """About `TASK_S` of trials, one pair at least, the first of them before a position."""
        most = TASK_S * self._trials / self._seconds if self._seconds else 0
        batch: list[int] = []
        while self._pairs and self._pairs[0][0] < before:
            if batch and len(batch) + len(self._pairs[0]) > most:
                break
            batch += self._pairs.popleft()
        return batch


class _Crew:
    """The tasks of one run that are submitted, and the trials that are not yet."""

    def __init__(self, client: Client, run: str, specs: Sequence[TrialSpec]) -> None:
        self._client, self._run, self._specs = client, run, specs
        self._batches = _Batches(specs)
        self._submitted: dict[Future[list[Result]], list[int]] = {}
        self._completed = as_completed(loop=client.loop)
        self._suspects: deque[int] = deque()
        self._alone: list[int] = []  # the suspect that is played, or was the last
        self._told: set[str] = set()
        self._scheduler = client.scheduler_info(n_workers=0)["id"]

    def __enter__(self) -> "_Crew":
        return self

    def __exit__(self, *_: object) -> None:
        if self._client.status == "running":  # else the scheduler is gone, and all that it had
            with suppress(Exception):
                self._client.cancel(list(self._submitted))
                self._client.unregister_worker_plugin(self._run)

    def prepare(self, open_player: OpenPlayer) -> None:
        """Have a player in each worker that is like this process, now and whenever one joins."""
        luggage = Luggage.of(self._specs)
        wanted = fingerprint(luggage.installed)
        player = TrialPlayer(self._run, open_player, luggage, wanted)
        try:
            self._client.register_plugin(player, name=self._run)
        except Exception as error:
            raise WorkerError(f"a worker cannot play: {in_one_line(error)}") from None
        self._refuse_unlike(wanted)
        self._client.subscribe_topic(self._run, lambda event: self._tell(event[1]))

    def _refuse_unlike(self, wanted: Mapping[str, str]) -> None:
        """Say which workers are not used. Raises WorkerError where there are no others."""
        workers = self._client.scheduler_info()["workers"]
        others = [name for name, own in workers.items() if self._run not in own["resources"]]
        if not others:
            return
        lines = [
            unlike(worker, why)
            for worker, why in self._client.run(difference, wanted, workers=others).items()
            if why is not None
        ]
        if lines and len(others) == len(workers):
            raise WorkerError(lines[0])
        for line in lines:
            self._tell(line)

    def _tell(self, line: str) -> None:
        if line not in self._told:
            self._told.add(line)
            warn(line)

    def work(self) -> Iterator[tuple[int, Result]]:
        self._submit_more()
        while self._submitted:
            future = next(self._completed)
            positions = self._submitted.pop(future)
            try:
                results = future.result()
            except KilledWorker as error:
                if result := self._killed(positions, error):
                    yield positions[0], result
            else:
                self._batches.played(results)
                yield from zip(positions, results, strict=True)
            self._submit_more()

    def _submit_more(self) -> None:
        tasks = TASKS_PER_WORKER * max(1, self._workers())
        if self._suspects:
            if not self._submitted:
                self._alone = [self._suspects.popleft()]
                self._submit(self._alone)
            return
        while len(self._submitted) < tasks:
            first = min(map(min, self._submitted.values()), default=len(self._specs))
            positions = self._batches.next(before=first + AHEAD)
            if not positions:
                return
            self._submit(positions)

    def _workers(self) -> int:
        """How many workers there are. Raises CancelledError where the scheduler is gone.

        Another one that was started in its place knows nothing of this run.
        """
        info = self._client.scheduler_info(n_workers=0)
        if self._client.status != "running" or info["id"] != self._scheduler:
            raise CancelledError
        return int(info["n_workers"])

    def _submit(self, positions: list[int]) -> None:
        specs = [self._specs[position] for position in positions]
        future = self._client.submit(
            play_batch, self._run, specs, pure=False, resources={self._run: 1}, retries=RETRIES
        )
        self._submitted[future] = positions
        self._completed.add(future)

    def _killed(self, positions: list[int], error: KilledWorker) -> Result | None:
        """Suspect each trial of a task whose workers died; one that was played alone is lost.

        Dask counts the death of a worker against all tasks that it was given: which trial was the
        cause shows when each is played with no other beside it.
        """
        if positions != self._alone:
            self._suspects.extend(positions)
            return None
        how = f"{error.allowed_failures + 1} worker processes ended in the middle of it"
        return lost_worker(self._specs[positions[0]], how)
