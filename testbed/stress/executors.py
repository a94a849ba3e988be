"""Where units are played: in this process, in others of this machine, or by workers of Dask."""

import signal
from collections.abc import Callable, Iterator
from concurrent.futures import Executor, Future, ProcessPoolExecutor
from contextlib import contextmanager
from importlib.util import find_spec
from multiprocessing import get_context
from typing import Any, TypeVar

from testbed.config import ExperimentConfig
from testbed.experiment.errors import WorkerError
from testbed.experiment.interrupts import SIGNALS, interrupts_later
from testbed.experiment.worker import safe_path

T = TypeVar("T")


class Here(Executor):
    """Runs each call in this process, when it is submitted."""

    def submit(self, call: Callable[..., T], /, *given: Any, **named: Any) -> Future[T]:
        """The result, or the error, in a future that is done."""
        future: Future[T] = Future()
        try:
            future.set_result(call(*given, **named))
        except Exception as error:  # of the call, which the future raises
            future.set_exception(error)
        return future


@contextmanager
def executor_of(config: ExperimentConfig, workers: int) -> Iterator[Executor]:
    """What plays units: so many processes, this one where it is a single one, or Dask's workers.

    Raises:
        WorkerError: where there is no Dask, or its scheduler is not there.
    """
    if config.runner == "dask":
        with _of_dask(config, workers) as executor:
            yield executor
    elif workers == 1:
        yield Here()
    else:
        pool = ProcessPoolExecutor(workers, get_context("spawn"), initializer=_deaf)
        try:
            with safe_path(), interrupts_later():  # processes are deaf from their first moment on
                for started in [pool.submit(int) for _ in range(workers)]:
                    started.result()
            yield pool
        finally:
            pool.shutdown(cancel_futures=True)


def _deaf() -> None:
    """Leave signals of the terminal to the driver."""
    for number in SIGNALS:
        signal.signal(number, signal.SIG_IGN)


@contextmanager
def _of_dask(config: ExperimentConfig, workers: int) -> Iterator[Executor]:
    if find_spec("distributed") is None:
        raise WorkerError("runner: dask is not installed; pip install 'intention-testbed[cluster]'")
    from testbed.experiment import dask_client  # noqa: PLC0415  # of an extra

    cluster: int | dask_client.Scheduler = workers
    if config.scheduler is not None:
        cluster = dask_client.Scheduler(config.scheduler, **config.tls.files)
    try:
        with dask_client.connected(cluster) as client:
            yield client.get_executor(pure=False)
    except (OSError, TimeoutError) as error:
        where = config.scheduler or "Dask"
        raise WorkerError(f"{where}: {error}") from None
