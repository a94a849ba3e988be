"""The run folder: records appended as trials end, and everything needed to go on or run again."""

from __future__ import annotations

import fcntl
import os
import shutil
from collections.abc import Iterator
from pathlib import Path
from types import TracebackType
from typing import BinaryIO, Self

import msgspec
import yaml

from testbed.config import ConfigError, ExperimentConfig, load_config
from testbed.config.levels import SCENARIO_KEYS
from testbed.experiment.errors import StoreError
from testbed.experiment.record import FAILURES, TrialRecord, decode, encode

TRIALS, CONFIG, PROVENANCE = "trials.jsonl", "config.yaml", "provenance.json"
SUMMARY, REPORT, ERRORS = "summary.json", "report.html", "errors"
ANY_RESULT = ("link", "limits.answer_s")  # keys on which no logical result depends


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


def read_config(folder: Path) -> ExperimentConfig:
    """The configuration stored in a run folder. Raises StoreError or ConfigError."""
    if not (folder / CONFIG).is_file():
        raise StoreError(f"{folder}: is not a run folder (it has no {CONFIG})")
    return load_config(folder / CONFIG)


def write_config(folder: Path, config: ExperimentConfig) -> None:
    """Write the resolved configuration, and beside it a domain or map that is not packaged."""
    folder.mkdir(parents=True, exist_ok=True)
    files = _own_files(config)
    for source in files.values():
        if source.parent != folder.resolve():
            shutil.copyfile(source, folder / source.name)
    config = config.model_copy(update={key: source.name for key, source in files.items()})
    replace_text(folder / CONFIG, config_text(config))


def _own_files(config: ExperimentConfig) -> dict[str, Path]:
    """The files that a configuration leads to, by its key."""
    files = {"domain": Path(config.domain)} if config.domain.endswith(".al") else {}
    refinement = Path(config.refinement or "")
    return files | {"refinement": refinement} if refinement.is_absolute() else files


def config_text(config: ExperimentConfig) -> str:
    """The configuration as YAML: every key with its value or default, of scenarios what is set.

    Keys of scenarios are left out where there are levels.
    """
    keys = config.model_dump(mode="json", exclude=set(SCENARIO_KEYS) if config.is_fine else None)
    if config.is_fine:
        return _yaml(keys)
    own = config.model_dump(mode="json", include={"scenario_settings"}, exclude_none=True)
    return _yaml(keys | own)


def _yaml(keys: dict[str, object]) -> str:
    return str(yaml.safe_dump(keys, sort_keys=False, width=100, allow_unicode=True))


def check_unchanged(folder: Path, config: ExperimentConfig) -> None:
    """Raise StoreError, showing the difference, unless `config` is the one stored in `folder`."""
    try:
        stored = flat_config(read_config(folder))
    except ConfigError as error:
        raise StoreError(str(error)) from None
    given = flat_config(config)
    changes = [
        f"  {key}: {stored.get(key, 'absent')} -> {given.get(key, 'absent')}"
        for key in [*stored, *(key for key in given if key not in stored)]
        if stored.get(key) != given.get(key) and key not in ANY_RESULT
    ]
    if changes:
        head = f"{folder}: its configuration is another one; resume it unchanged or choose --out"
        raise StoreError("\n".join([head, *changes]))


def flat_config(config: ExperimentConfig) -> dict[str, object]:
    """The keys that are set, nested ones with dots, and the texts of its own files."""
    flat: dict[str, object] = {}

    def walk(prefix: str, value: object) -> None:
        if isinstance(value, dict):
            for key, item in value.items():
                walk(f"{prefix}{key}.", item)
        else:
            flat[prefix.removesuffix(".")] = value

    walk("", config.model_dump(mode="json", exclude_none=True))
    for key, file in _own_files(config).items():
        flat[key] = file.name
        flat[f"{key} text"] = file.read_text(encoding="utf-8")
    return flat


def replace_text(path: Path, text: str) -> None:
    """Write a file so that a reader finds the old one or the new one, never a part."""
    draft = path.with_name(path.name + ".part")
    draft.write_text(text, encoding="utf-8")
    os.replace(draft, path)


def read_records(folder: Path) -> Iterator[TrialRecord]:
    """The records of a run, one at a time, also while it grows: a torn last line is left out.

    Raises:
        StoreError: for a line in the middle that is not a record.
    """
    path = folder / TRIALS
    if not path.is_file():
        return
    with path.open("rb") as lines:
        for number, line in enumerate(lines, start=1):
            if not line.endswith(b"\n"):
                return
            try:
                yield decode(line)
            except msgspec.DecodeError as error:
                raise StoreError(f"{path}:{number}: not a record of a trial: {error}") from None


class TrialWriter:
    """Appends records to a run folder's `trials.jsonl`; at most one writer a folder.

    Opening it drops a torn last line; `done` then holds the ids of the trials on record, and
    `failed` counts those that ended in error or lost their robot.
    """

    def __init__(self, folder: Path) -> None:
        folder.mkdir(parents=True, exist_ok=True)
        self._file: BinaryIO = (folder / TRIALS).open("ab")
        try:
            fcntl.flock(self._file, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except OSError:
            self._file.close()
            raise StoreError(f"{folder}: another run is writing here") from None
        _drop_torn_line(folder / TRIALS)
        self.done: set[str] = set()
        self.failed = 0
        for record in read_records(folder):
            self._count(record)

    def append(self, record: TrialRecord) -> None:
        """Write one record, visible to readers at once."""
        self._file.write(encode(record))
        self._file.flush()
        self._count(record)

    def _count(self, record: TrialRecord) -> None:
        self.done.add(record.trial)
        self.failed += record.outcome in FAILURES

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        os.fsync(self._file.fileno())
        self._file.close()


def _drop_torn_line(path: Path) -> None:
    with path.open("r+b") as file:
        end = file.seek(0, os.SEEK_END)
        while end > 0:
            file.seek(end - 1)
            if file.read(1) == b"\n":
                break
            end -= 1
        file.truncate(end)
