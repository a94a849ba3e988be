"""Keep what is whole of a damaged run folder."""

from __future__ import annotations

import shutil
from collections import Counter
from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import dataclass
from itertools import count
from pathlib import Path

import msgspec

from testbed.experiment.conformity import strangeness
from testbed.experiment.errors import StoreError
from testbed.experiment.plan import plan_trials
from testbed.experiment.record import NewerVersionError, TrialRecord, decode, logical
from testbed.experiment.retries import settle
from testbed.experiment.run_config import read_config
from testbed.experiment.run_folder import TRIALS, locked, replace_lines
from testbed.experiment.specs import TrialSpec
from testbed.text.wording import counted


@dataclass(frozen=True)
class _Line:
    """A line of the records: of which trial, with what results, or why it is not whole."""

    number: int
    trial: str = ""
    results: int = 0
    fault: str | None = None


def repair(folder: Path, say: Callable[[str], None]) -> None:
    """Drop the lines of a run's records that are not whole, and say which and why.

    Dropped are lines that are no records or do not match their checksums, records of no planned
    trial, and further ones of a trial; all of it where these have different results. The old file
    is kept beside the new one.

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
        with path.open("rb") as file:
            lines = [
                _read(path, number, line, planned) for number, line in enumerate(file, start=1)
            ]
        dropped = _dropped(lines)
        for number, fault in sorted(dropped.items()):
            say(f"{path}:{number}: dropped: {fault}")
        if dropped:
            say(f"{path}: as it was: {_keep_old(path)}")
            with path.open("rb") as file:
                kept = (line for number, line in enumerate(file, 1) if number not in dropped)
                replace_lines(path, kept)
        whole = len(lines) - len(dropped)
        say(f"{path}: {whole} of {counted(len(planned), 'trial')} whole, {len(dropped)} dropped")


def _read(path: Path, number: int, line: bytes, planned: Mapping[str, TrialSpec]) -> _Line:
    if not line.endswith(b"\n"):
        return _Line(number, fault="torn")
    try:
        record = decode(line)
    except msgspec.DecodeError as error:
        return _Line(number, fault=f"not a record of a trial: {error}")
    except NewerVersionError as error:
        raise StoreError(f"{path}:{number}: {error}") from None
    fault = strangeness(record, planned.get(record.trial))
    return _Line(number, record.trial, _results(record), fault)


def _results(record: TrialRecord) -> int:
    return hash(msgspec.json.encode(logical(record), enc_hook=str))


def _dropped(lines: Iterable[_Line]) -> dict[int, str]:
    """Why lines are dropped, by their numbers."""
    faults = {line.number: line.fault for line in lines if line.fault is not None}
    sound = [line for line in lines if line.fault is None]
    results = Counter(trial for trial, _ in {(line.trial, line.results) for line in sound})
    return faults | dict(_repeated(sound, results))


def _repeated(sound: Iterable[_Line], results: Mapping[str, int]) -> Iterator[tuple[int, str]]:
    first: dict[str, int] = {}
    for line in sound:
        if results[line.trial] > 1:
            yield line.number, f"trial {line.trial} has lines with different results"
        elif first.setdefault(line.trial, line.number) != line.number:
            yield line.number, f"trial {line.trial} is at line {first[line.trial]}, too"


def _keep_old(path: Path) -> Path:
    names = (path.with_name(f"{path.name}.damaged{suffix}") for suffix in _suffixes())
    old = next(name for name in names if not name.exists())
    shutil.copy2(path, old)
    return old


def _suffixes() -> Iterator[str]:
    yield ""
    yield from (f"-{number}" for number in count(2))
