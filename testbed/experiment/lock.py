"""The lock of a run folder: one process at a time writes into it."""

import fcntl
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import BinaryIO

from testbed.experiment.errors import StoreError

LOCK = ".lock"


@contextmanager
def locked(folder: Path) -> Iterator[None]:
    """Be the only one who writes into a run folder, as long as this block or process lasts.

    Raises:
        StoreError: where another one is.
    """
    folder.mkdir(parents=True, exist_ok=True)
    with (folder / LOCK).open("ab") as lock:
        while not _got(lock, fcntl.LOCK_EX):
            if _is_taken(lock):  # else somebody has only asked whether it is
                raise StoreError(f"{folder}: another run is writing here")
        yield


def is_written(folder: Path) -> bool:
    """Whether a process writes into a run folder."""
    try:
        with (folder / LOCK).open("rb") as lock:
            return _is_taken(lock)
    except FileNotFoundError:
        return False


def _is_taken(lock: BinaryIO) -> bool:
    if not _got(lock, fcntl.LOCK_SH):
        return True
    fcntl.flock(lock, fcntl.LOCK_UN)
    return False


def _got(lock: BinaryIO, kind: int) -> bool:
    try:
        fcntl.flock(lock, kind | fcntl.LOCK_NB)
    except BlockingIOError:
        return False
    return True
