"""Schedulers and workers of Dask as processes of their own, and a run that they play."""

import json
import os
import subprocess
import sys
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path

from tests.greenhouse import GREENHOUSE

ROOT = Path(__file__).parents[1]
PATIENCE_S = 600.0
POTS = """\
name: pots
domain: pots.al
goal: ["stands(fern,sill)"]
link: inprocess
repeats: 2
adversary: {strategy: random, rate: 0.3}
"""
"""36 trials of two robots, in which others act at random."""


def write_pots(folder: Path) -> Path:
    """The configuration and its domain, in a folder."""
    folder.mkdir(exist_ok=True)
    (folder / "pots.al").write_text(GREENHOUSE, encoding="utf-8")
    (folder / "pots.yaml").write_text(POTS, encoding="utf-8")
    return folder / "pots.yaml"


def until(reached: Callable[[], object], process: subprocess.Popen[str] | None = None) -> None:
    """Wait for a state, as long as a process lasts that is to reach it."""
    end = time.monotonic() + PATIENCE_S
    while not reached():
        assert time.monotonic() < end
        assert process is None or process.poll() is None, process.communicate()
        time.sleep(0.02)


@contextmanager
def started(*command: str, cwd: Path, path: Path = ROOT) -> Iterator[subprocess.Popen[str]]:
    """A Python that imports from `path`, killed at the end of the block."""
    process = subprocess.Popen(
        [sys.executable, *command],
        cwd=cwd,
        env={**os.environ, "PYTHONPATH": str(path)},
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
    )
    try:
        yield process
    finally:
        process.kill()
        process.communicate()


@contextmanager
def scheduler(cwd: Path) -> Iterator[str]:
    """The address of a scheduler without workers."""
    file = cwd / "scheduler.json"
    where = ("--host", "127.0.0.1", "--port", "0", "--no-dashboard", "--scheduler-file", str(file))
    with started("-m", "distributed.cli.dask_scheduler", *where, cwd=cwd) as process:
        until(lambda: file.exists() and file.read_text().endswith("}"), process)
        yield json.loads(file.read_text())["address"]


@contextmanager
def worker(address: str, cwd: Path, path: Path = ROOT) -> Iterator[subprocess.Popen[str]]:
    """A worker that is started in a folder of its own; it need not have joined yet."""
    cwd.mkdir(exist_ok=True)
    alone = ("--nthreads", "1", "--no-nanny", "--no-dashboard", "--memory-limit", "0")
    with started("-m", "distributed.cli.dask_worker", address, *alone, cwd=cwd, path=path) as own:
        yield own
