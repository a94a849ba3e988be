"""A run whose driver is killed in the middle, and which then goes on."""

from __future__ import annotations

import signal
import subprocess
import time
from collections.abc import Iterator, Sequence
from pathlib import Path

POLL_S = 0.01


class NotKilledError(RuntimeError):
    """The run ended by itself before it was killed."""


def killed_at(records: int, command: Sequence[str], folder: Path) -> bytes:
    """Kill (SIGKILL) the driver that `command` starts when `folder` has so many records.

    The whole lines of `trials.jsonl` that it leaves.

    Raises:
        NotKilledError: where the driver ends before that.
    """
    path = folder / "trials.jsonl"
    driver = subprocess.Popen(command, stdout=subprocess.DEVNULL)
    try:
        lines = _growing(path)
        while next(lines) < records:
            if driver.poll() is not None:
                break
            time.sleep(POLL_S)
    finally:
        driver.kill()
        driver.wait()
    if driver.returncode != -signal.SIGKILL:
        raise NotKilledError(f"{folder}: its driver ended before it was killed")
    return whole_lines(path)


def whole_lines(path: Path) -> bytes:
    """What a file of lines holds without a torn last one."""
    kept = path.read_bytes()
    return kept[: kept.rfind(b"\n") + 1]


def _growing(path: Path) -> Iterator[int]:
    """How many lines a file has, whenever asked; none where it is not there yet."""
    while not path.is_file():
        yield 0
    lines = 0
    with path.open("rb") as file:
        while True:
            lines += file.read().count(b"\n")
            yield lines
