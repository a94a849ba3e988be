"""Merge the parts of a run, each played into a folder of its own, into one run folder."""

import shutil
from collections.abc import Iterable, Iterator, Mapping, Sequence
from pathlib import Path
from typing import Any

from testbed.config import ExperimentConfig
from testbed.experiment.errors import StoreError
from testbed.experiment.lock import locked
from testbed.experiment.pilot import Pilot
from testbed.experiment.plan import coverage_of, plan_trials
from testbed.experiment.provenance import Provenance, sessions_of
from testbed.experiment.run_folder import (
    ERRORS,
    STORIES,
    TRIALS,
    choose_folder,
    differences,
    read_config,
    replace_lines,
    write_config,
)
from testbed.experiment.specs import TrialSpec
from testbed.experiment.store import read_records, settle
from testbed.experiment.stories import story_lines

Line = tuple[Path, int, int]
"""A line of records: its file, where it begins, how long it is."""


def merge(folders: Sequence[Path], out: Path, command: Sequence[str]) -> ExperimentConfig:
    """Merge run folders whose trials are those of one configuration; returns that.

    The records are in the order of play, as after a run that nothing disturbed.

    Raises:
        StoreError: for folders with other configurations, or played with other versions; for a
            trial that two of them have; where trials are missing; where `out` holds a run.
        ConfigError: where a stored configuration is not valid any more.
    """
    choose_folder(out, "", resume=False)
    config = read_config(folders[0])
    for folder in folders[1:]:
        if changed := differences(read_config(folder), config):
            raise StoreError(f"{folder}: is another run than {folders[0]}: {changed[0]}")
    sessions = _sessions(folders)
    specs = plan_trials(config)
    lines = _lines(folders, specs)
    places = [(s.scenario, s.level) for s in specs if s.trial in lines]
    if missing := coverage_of(places, config).notice():
        raise StoreError(f"{out}: is not made: {missing}; play the shards that are missing")
    with locked(out):
        write_config(out, config)
        provenance = Provenance(out, config, command, sessions)
        order = Pilot(specs).order if config.is_sweep else specs
        replace_lines(out / TRIALS, _read(lines[spec.trial] for spec in order))
        replace_lines(out / STORIES, _stories(folders, lines))
        for folder in folders:
            if (folder / ERRORS).is_dir():
                shutil.copytree(folder / ERRORS, out / ERRORS, dirs_exist_ok=True)
        provenance.close(0, workers=0)
    return config


def _stories(folders: Iterable[Path], lines: Mapping[str, Line]) -> Iterator[bytes]:
    """The stories of the trials that each folder has on record."""
    for folder in folders:
        for trial, line in story_lines(folder):
            if trial in lines and lines[trial][0].parent == folder:
                yield line


def _sessions(folders: Iterable[Path]) -> list[dict[str, Any]]:
    """All sessions in which the parts were played. Raises StoreError for other versions."""
    own = [(folder, session) for folder in folders for session in sessions_of(folder)]
    for folder, session in own:
        first_folder, first = own[0]
        versions, others = first.get("versions") or {}, session.get("versions") or {}
        for name in {**versions, **others}:
            here, there = others.get(name), versions.get(name)
            if here != there:
                told = f"was played with {name} {here}, and {first_folder} with {there}"
                raise StoreError(f"{folder}: {told}")
    return [session for _, session in own]


def _lines(folders: Iterable[Path], specs: Sequence[TrialSpec]) -> Mapping[str, Line]:
    """Where the record of each trial is. Raises StoreError for a trial that is on record twice."""
    found: dict[str, Line] = {}
    for folder in folders:
        if not (folder / TRIALS).is_file():
            continue
        settle(folder)
        offset = 0
        with (folder / TRIALS).open("rb") as file:
            for record, text in zip(read_records(folder, specs), file, strict=False):
                if record.trial in found:
                    other = found[record.trial][0].parent
                    raise StoreError(f"{folder}: trial {record.trial} is on record in {other}, too")
                found[record.trial] = folder / TRIALS, offset, len(text)
                offset += len(text)
    return found


def _read(lines: Iterable[Line]) -> Iterator[bytes]:
    for path, offset, length in lines:
        with path.open("rb") as file:
            file.seek(offset)
            yield file.read(length)
