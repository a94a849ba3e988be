"""The folder of a run: where it is, what its files are called, how they are replaced."""

from __future__ import annotations

import os
from pathlib import Path

from testbed.experiment.errors import StoreError

TRIALS, CONFIG, PROVENANCE = "trials.jsonl", "config.yaml", "provenance.json"
SUMMARY, REPORT, ERRORS = "summary.json", "report.html", "errors"


def choose_folder(out: Path | None, name: str, resume: bool) -> Path:
    """The folder of a run: `out`, or `runs/NAME`, numbered where that one is taken.

    With `resume` it is the newest of the numbered ones.

    Raises:
        StoreError: when `out` holds a run already and is not to be resumed.
    """
    if out is not None:
        if out.exists() and not out.is_dir():
            raise StoreError(f"{out}: is not a folder")
        if holds_run(out) and not resume:
            raise StoreError(f"{out}: holds a run already; --resume goes on with it")
        return out
    folder, following = Path("runs") / name, Path("runs") / name
    number = 1
    while following.exists():
        number, folder = number + 1, following
        following = Path("runs") / f"{name}-{number}"
    return folder if resume else following


def holds_run(folder: Path) -> bool:
    """Whether a run was started in this folder."""
    return (folder / CONFIG).is_file() or (folder / TRIALS).is_file()


def replace_text(path: Path, text: str) -> None:
    """Write a file so that a reader finds the old one or the new one, never a part."""
    draft = path.with_name(path.name + ".part")
    draft.write_text(text, encoding="utf-8")
    os.replace(draft, path)
