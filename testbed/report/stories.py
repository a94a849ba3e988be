"""Single trials: step by step, the slowest, those that were not correct, and what was explained."""

from __future__ import annotations

import shlex
from collections import Counter
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path

import polars as pl

from testbed.analysis.table import records_of
from testbed.experiment.record import COARSE, FAILURES, Explained, TrialRecord
from testbed.experiment.timeline import Step, exception, in_words, of_place, timeline

SHOWN = 60
"""Trials told step by step; of a larger run those that failed come first."""
SLOWEST = 10
MOST = 12
"""Explanations of a robot that are shown."""
NOTHING = "nothing"


@dataclass(frozen=True)
class Story:
    """A trial as the report tells it."""

    record: TrialRecord
    steps: tuple[Step, ...]


@dataclass(frozen=True)
class Chapter:
    """The told trials of a scenario or level; `note` is what the domain says of it, or ""."""

    title: str
    note: str
    stories: tuple[Story, ...]


def chapters(trials: pl.DataFrame, notes: Mapping[str, str]) -> Iterator[Chapter]:
    """The told trials of a run by scenario or level; `notes` are the domain's, by scenario."""
    stories: dict[tuple[str, str], list[Story]] = {}
    for record in records_of(_worth_telling(trials)):
        story = Story(record, tuple(timeline(record)))
        stories.setdefault((record.scenario, record.level), []).append(story)
    for (scenario, level), told in stories.items():
        note = notes.get(scenario, "") if level == COARSE else ""
        yield Chapter(of_place(scenario, level), note, tuple(told))


def _worth_telling(trials: pl.DataFrame) -> pl.DataFrame:
    """At most `SHOWN` trials, in their order: what went wrong first, then the others."""
    wrong = pl.col("outcome").is_in(FAILURES) | ~pl.col("achieved")
    numbered = trials.with_row_index("number")
    chosen = pl.concat([numbered.filter(wrong), numbered.filter(~wrong)]).head(SHOWN)
    return chosen.sort("number").drop("number")


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


def slowest(trials: pl.DataFrame, folder: Path) -> list[Slow]:
    """The trials with most reasoning, the slowest first."""
    chosen = trials.sort("reasoning_time_s", descending=True, maintain_order=True).head(SLOWEST)
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
        for record in records_of(chosen)
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


@dataclass(frozen=True)
class Account:
    """An explanation, and how often it was adopted.

    `happened` is what others had done by then without telling, `right` whether the explanation
    names just that, whatever the steps.
    """

    happened: str
    explained: str
    count: int
    right: bool


@dataclass(frozen=True)
class Accounts:
    """The explanations of one robot: the most frequent ones, and how many there are in all."""

    robot: str
    total: int
    right: int
    common: tuple[Account, ...]
    kinds: int


def accounts_of(records: Iterable[TrialRecord]) -> list[Accounts]:
    """What each robot explained by what, in the order in which records name the robots."""
    counts: dict[str, Counter[tuple[str, str]]] = {}
    for record in records:
        own = counts.setdefault(record.robot, Counter())
        own.update((_happened(record, e.step), _assumed(e)) for e in record.explanations)
    return [_accounts(robot, own) for robot, own in counts.items() if own]


def _accounts(robot: str, counts: Counter[tuple[str, str]]) -> Accounts:
    ordered = sorted(counts.items(), key=lambda item: (-item[1], item[0]))
    told = [
        Account(happened, explained, count, happened == explained)
        for (happened, explained), count in ordered
    ]
    right = sum(account.count for account in told if account.right)
    return Accounts(robot, counts.total(), right, tuple(told[:MOST]), len(told))


def _happened(record: TrialRecord, step: int) -> str:
    """What others had done before a step, and the robot was not told of."""
    unseen = (e.action for e in record.exogenous if e.step < step and not e.observed)
    return _said(sorted(unseen))


def _assumed(explained: Explained) -> str:
    """Exceptions first, then what others did, then what is distrusted, whatever they are called."""
    exceptions = sorted(map(exception, explained.exceptions))
    events = sorted(event.action for event in explained.unobserved)
    distrusted = sorted(f"distrusted {report.action}" for report in explained.distrusted)
    return _said([*exceptions, *events, *distrusted])


def _said(names: list[str]) -> str:
    return " ".join(names) or NOTHING
