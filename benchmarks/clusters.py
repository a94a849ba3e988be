"""Schedulers and workers of Dask as processes of their own."""

import json
import os
import subprocess
import sys
import time
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path

ROOT = Path(__file__).parents[1]
PATIENCE_S = 600.0
ALONE = ("--nthreads", "1", "--no-nanny", "--no-dashboard", "--memory-limit", "0")

Process = subprocess.Popen[str]


@dataclass(frozen=True)
class Scheduler:
    """A scheduler that listens; its workers are to be started."""

    address: str
    process: Process


def until(reached: Callable[[], object], process: Process | None = None) -> None:
    """Wait for a state, as long as a process lasts that is to reach it."""
    end = time.monotonic() + PATIENCE_S
    while not reached():
        assert time.monotonic() < end
        assert process is None or process.poll() is None, process.communicate()
        time.sleep(0.02)


@contextmanager
def started(*command: str, cwd: Path, path: Sequence[Path] = (ROOT,)) -> Iterator[Process]:
    """A Python in a group of its own, which imports from `path`, killed at the end of the block."""
    process = subprocess.Popen(
        [sys.executable, *command],
        cwd=cwd,
        env={**os.environ, "PYTHONPATH": os.pathsep.join(map(str, path))},
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
        start_new_session=True,
    )
    try:
        yield process
    finally:
        process.kill()
        process.communicate()


@contextmanager
def scheduler(cwd: Path, *options: str, host: str = "127.0.0.1") -> Iterator[Scheduler]:
    """A scheduler that is started in a folder of its own, without workers."""
    cwd.mkdir(exist_ok=True)
    file = cwd / "scheduler.json"
    where = ("--host", host, "--port", "0", "--no-dashboard", "--scheduler-file", str(file))
    command = ("-m", "distributed.cli.dask_scheduler", *where, *options)
    with started(*command, cwd=cwd) as process:
        until(lambda: file.exists() and file.read_text().endswith("}"), process)
        yield Scheduler(json.loads(file.read_text())["address"], process)


@contextmanager
def worker(
    address: str, cwd: Path, *options: str, path: Sequence[Path] = (ROOT,)
) -> Iterator[Process]:
    """A worker that is started in a folder of its own; it need not have joined yet."""
    cwd.mkdir(exist_ok=True)
    command = ("-m", "distributed.cli.dask_worker", address, *ALONE, *options)
    with started(*command, cwd=cwd, path=path) as own:
        yield own
