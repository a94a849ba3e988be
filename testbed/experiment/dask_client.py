"""The client of a Dask cluster: that of a scheduler, or one that is started on this machine."""

import logging
import ssl
import warnings
from collections.abc import Iterator
from contextlib import ExitStack, contextmanager
from dataclasses import dataclass
from pathlib import Path

import dask
from distributed import Client, LocalCluster, Security
from distributed.utils import LoopRunner

from testbed.experiment.errors import WorkerError
from testbed.experiment.interrupts import interrupts_later
from testbed.experiment.worker import safe_path

LOST_S = 3600.0
DASHBOARD = "127.0.0.1:8787"
LOGGERS = ("distributed", "distributed.client")  # each has a level of its own


@dataclass(frozen=True)
class Scheduler:
    """Where a scheduler listens, and the files for TLS: authority, certificate, key."""

    address: str
    ca: str | None = None
    cert: str | None = None
    key: str | None = None

    def security(self) -> Security:
        """What Dask is told of the files. Raises WorkerError for one that is of no use."""
        if self.ca is None or self.cert is None:
            return Security()
        for name in ("ca", "cert", "key"):
            file = getattr(self, name)
            with _refused(f"tls.{name}: {file}"):
                Path(file or self.cert).open("rb").close()
        with _refused(f"tls.ca: {self.ca}"):
            context = ssl.create_default_context(cafile=self.ca)
        with _refused(f"tls.cert, tls.key: {self.cert}, {self.key or self.cert}"):
            context.load_cert_chain(self.cert, self.key)
        return Security(
            require_encryption=True,
            tls_ca_file=self.ca,
            tls_client_cert=self.cert,
            tls_client_key=self.key,
        )


@contextmanager
def _refused(what: str) -> Iterator[None]:
    try:
        yield
    except OSError as error:
        raise WorkerError(f"{what}: {error.strerror or error}") from None


@contextmanager
def connected(cluster: int | Scheduler) -> Iterator[Client]:
    """A client of a scheduler, or of a cluster of so many workers, closed at the end of the block.

    Raises:
        OSError: when there is no scheduler.
        WorkerError: for a file for TLS that is of no use.
    """
    for name in LOGGERS:
        logging.getLogger(name).setLevel(logging.CRITICAL)
    with ExitStack() as stack:
        security = cluster.security() if isinstance(cluster, Scheduler) else None
        runner = LoopRunner()
        with interrupts_later():  # its thread, and processes that it starts, are deaf to signals
            runner.start()
        stack.callback(runner.stop)
        if isinstance(cluster, Scheduler):
            address: str | LocalCluster = cluster.address
        else:
            address = stack.enter_context(_local(cluster, runner))
        client = Client(address, security=security, loop=runner.loop, set_as_default=False)
        yield stack.enter_context(client)


@contextmanager
def _local(workers: int, runner: LoopRunner) -> Iterator[LocalCluster]:
    # Dask gives up a worker whose successor takes longer, as on a busy machine it may.
    lost = {"distributed.deploy.lost-worker-timeout": LOST_S}
    with safe_path(), dask.config.set(lost):
        with warnings.catch_warnings():
            warnings.filterwarnings("ignore", r"\s*Port \d+ is already in use")
            cluster = LocalCluster(
                n_workers=workers,
                threads_per_worker=1,
                memory_limit=0,
                dashboard_address=DASHBOARD,
                loop=runner.loop,
                silence_logs=logging.CRITICAL,
            )
        with cluster:
            yield cluster


def dashboard_of(client: Client) -> str | None:
    """The address of the page on which Dask shows what the cluster does; None without one."""
    try:
        return client.dashboard_link or None
    except KeyError:  # a scheduler that was started without
        return None
