"""The folder of a run: where it is, what its files are called, how they are replaced."""

from __future__ import annotations

import fcntl
import os
from collections.abc import Iterable, Iterator
from contextlib import contextmanager
from itertools import count
from pathlib import Path

from testbed.experiment.errors import StoreError

TRIALS, CONFIG, PROVENANCE = "trials.jsonl", "config.yaml", "provenance.json"
SUMMARY, REPORT, ERRORS = "summary.json", "report.html", "errors"
LOCK = ".lock"


def choose_folder(out: Path | None, name: str, resume: bool) -> Path:
    """The folder of a run: `out`, or a new one, `runs/NAME`, numbered where that one is taken.

    With `resume` it is the newest of the numbered ones.

    Raises:
        StoreError: when `out` holds a run already and is not to be resumed.
    """
    if out is None:
        return _newest(name) if resume else _new(name)
    if out.exists() and not out.is_dir():
        raise StoreError(f"{out}: is not a folder")
    refuse_second_run(out, resume)
    return out


def refuse_second_run(folder: Path, resume: bool) -> None:
    """Raise StoreError where a folder holds a run already which is not to be resumed."""
    if holds_run(folder) and not resume:
        raise StoreError(f"{folder}: holds a run already; --resume goes on with it")


def _numbered(name: str) -> Iterator[Path]:
    yield Path("runs") / name
    yield from (Path("runs") / f"{name}-{number}" for number in count(2))


def _newest(name: str) -> Path:
    newest = Path("runs") / name
    for folder in _numbered(name):
        if not folder.exists():
            break
        newest = folder
    return newest


def _new(name: str) -> Path:
    """A folder that is made here, so that no other run can choose it as well."""
    for folder in _numbered(name):
        folder.parent.mkdir(parents=True, exist_ok=True)
        try:
            folder.mkdir()
        except FileExistsError:
            continue
        return folder
    raise AssertionError("numbers do not end")


@contextmanager
def locked(folder: Path) -> Iterator[None]:
    """Be the only one who writes into a run folder, as long as this block or process lasts.

    Raises:
        StoreError: where another one is.
    """
    folder.mkdir(parents=True, exist_ok=True)
    with (folder / LOCK).open("ab") as lock:
        try:
            fcntl.flock(lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except BlockingIOError:
            raise StoreError(f"{folder}: another run is writing here") from None
        yield


@contextmanager
def naming(path: Path) -> Iterator[None]:
    """Let errors of writing say the file, which those of a full disk do not."""
    try:
        yield
    except OSError as error:
        if error.filename is not None:
            raise
        raise OSError(error.errno, error.strerror, str(path)) from error


def holds_run(folder: Path) -> bool:
    """Whether a run was started in this folder."""
    return (folder / CONFIG).is_file() or (folder / TRIALS).is_file()


def replace_text(path: Path, text: str) -> None:
    """Write a file so that a reader finds the old one or the new one, never a part."""
    draft = path.with_name(path.name + ".part")
    with naming(path):
        draft.write_text(text, encoding="utf-8")
    os.replace(draft, path)


def replace_lines(path: Path, lines: Iterable[bytes]) -> None:
    """As `replace_text`, of lines that reach the disk before the old ones leave it."""
    draft = path.with_name(path.name + ".part")
    with naming(path), draft.open("wb") as file:
        file.writelines(lines)
        file.flush()
        os.fsync(file.fileno())
    os.replace(draft, path)
