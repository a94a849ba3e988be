"""The trials to look into: the slowest ones, and every one that was not correct."""

from __future__ import annotations

import heapq
import shlex
from collections.abc import Iterable
from dataclasses import dataclass
from pathlib import Path

from testbed.experiment.record import FAILURES, TrialRecord
from testbed.experiment.wording import in_words, of_place

SLOWEST = 10


@dataclass(frozen=True)
class Slow:
    """One of the trials that took the robot most reasoning; `seconds` are those of the trial."""

    place: str
    robot: str
    outcome: str
    plans: int
    steps: int
    seconds: float
    command: str


@dataclass(frozen=True)
class Failed:
    """The trials of one robot that ended alike: of each its command, with what others did."""

    place: str
    robot: str
    ending: str
    lost: bool
    lines: tuple[tuple[str, str], ...]


def command_of(folder: Path, trial: str) -> str:
    """The command that replays a trial."""
    return f"testbed replay {shlex.quote(str(folder))} --trial {trial}"


def slowest(records: Iterable[TrialRecord], folder: Path) -> list[Slow]:
    """The trials with most reasoning, the slowest first."""
    chosen = heapq.nlargest(SLOWEST, records, key=lambda record: record.reasoning_time_s)
    return [
        Slow(
            place=of_place(record.scenario, record.level),
            robot=record.robot,
            outcome=in_words(record.outcome),
            plans=record.plans,
            steps=record.steps,
            seconds=record.reasoning_time_s,
            command=command_of(folder, record.trial),
        )
        for record in chosen
    ]


def failures(records: Iterable[TrialRecord], folder: Path) -> list[Failed]:
    """Every trial that is not correct, by place, robot and ending; lost ones and errors first."""
    groups: dict[tuple[str, str, str, bool], list[tuple[str, str]]] = {}
    for record in records:
        if record.correct is False or record.lost:
            lost = record.outcome in FAILURES
            key = (of_place(record.scenario, record.level), record.robot, _ending(record), lost)
            line = (command_of(folder, record.trial), _events(record))
            groups.setdefault(key, []).append(line)
    found = [Failed(*key, tuple(lines)) for key, lines in groups.items()]
    return sorted(found, key=lambda group: not group.lost)


def _ending(record: TrialRecord) -> str:
    if record.outcome == "achieved":
        return "achieved, not with the fewest actions"
    reach = ", out of reach" if record.in_reach is False else ""
    reason = f": {record.reason}" if record.outcome in FAILURES and record.reason else ""
    return f"{in_words(record.outcome)}{reach}{reason}"


def _events(record: TrialRecord) -> str:
    return ", ".join(f"{event.action} at step {event.step}" for event in record.exogenous)
