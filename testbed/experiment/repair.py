"""Keep the intact records of a damaged run folder."""

import shutil
from collections import defaultdict
from collections.abc import Mapping
from itertools import chain, compress, count
from pathlib import Path

import msgspec

from testbed.experiment.digest import logical
from testbed.experiment.lock import locked
from testbed.experiment.plan import plan_trials
from testbed.experiment.recorder import strangeness
from testbed.experiment.run_folder import STORIES, TRIALS, read_config, replace_lines
from testbed.experiment.specs import TrialSpec
from testbed.experiment.store import read_lines, settle
from testbed.experiment.stories import is_whole
from testbed.text import Say, counted


def repair(folder: Path, say: Say) -> None:
    """Drop the lines of a run's records that are not whole, and say which and why.

    Dropped are lines that are no records or do not match their checksums, records of no planned
    trial, and further ones of a trial; all of it where these have different results. The old file
    is kept beside the new one. Of the stories the lines are dropped that are none.

    Raises:
        StoreError: for a folder without a run, with one that goes on, or with records that a
            newer testbed wrote.
        ConfigError: where the stored configuration is not valid any more.
    """
    planned = {spec.trial: spec for spec in plan_trials(read_config(folder))}
    path = folder / TRIALS
    with locked(folder):
        settle(folder)
        path.touch()
        faults = _faults(path, planned)
        dropped = {number: fault for number, fault in faults.items() if fault is not None}
        for number, fault in dropped.items():
            say(f"{path}:{number}: dropped: {fault}")
        if dropped:
            say(f"{path}: as it was: {_keep_old(path)}")
            with path.open("rb") as file:
                kept = (line for number, line in enumerate(file, 1) if number not in dropped)
                replace_lines(path, kept)
        _repair_stories(folder / STORIES, say)
        whole = len(faults) - len(dropped)
        say(f"{path}: {whole} of {counted(len(planned), 'trial')} whole, {len(dropped)} dropped")


def _repair_stories(path: Path, say: Say) -> None:
    if not path.is_file():
        return
    with path.open("rb") as file:
        whole = [is_whole(line) for line in file]
        if not all(whole):
            file.seek(0)
            replace_lines(path, compress(file, whole))
            say(f"{path}: dropped {counted(whole.count(False), 'line')} not whole")


def _faults(path: Path, planned: Mapping[str, TrialSpec]) -> dict[int, str | None]:
    """By the number of a line why it is not kept; None for one that is."""
    faults: dict[int, str | None] = {}
    results: dict[str, dict[int, int]] = defaultdict(dict)  # by trial and line, as a hash
    for number, _, record, fault in read_lines(path):
        faults[number] = fault
        if record is not None:
            faults[number] = strangeness(record, planned.get(record.trial))
            if faults[number] is None:
                outcome = msgspec.json.encode(logical(record), enc_hook=str)
                results[record.trial][number] = hash(outcome)
    for trial, by_line in results.items():
        first, *others = by_line
        if len({*by_line.values()}) > 1:
            faults |= dict.fromkeys(by_line, f"trial {trial} has lines with different results")
        else:
            faults |= dict.fromkeys(others, f"trial {trial} is at line {first}, too")
    return faults


def _keep_old(path: Path) -> Path:
    old = path.with_name(f"{path.name}.damaged")
    numbered = (path.with_name(f"{old.name}-{number}") for number in count(2))
    free = next(name for name in chain([old], numbered) if not name.exists())
    shutil.copy2(path, free)
    return free
