"""Single trials: step by step, the slowest, those that were not correct, and what was explained."""

import shlex
from collections import Counter
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import NamedTuple

import polars as pl

from testbed.analysis.table import records_of
from testbed.experiment.record import COARSE, FAILURES, Explained, TrialRecord
from testbed.experiment.timeline import exception, in_words, of_place

SHOWN = 60
"""Trials told step by step; of a larger run those that failed come first."""
SLOWEST = 10
MOST = 12
"""Explanations of a robot that are shown."""
NOTHING = "nothing"
WRONG = pl.col("correct").fill_null(True).not_() | pl.col("outcome").is_in(FAILURES)
"""Of the trials that are told as failures: all others are passed over."""


def chapters(
    trials: pl.DataFrame, notes: Mapping[str, str]
) -> Iterator[tuple[str, str, list[TrialRecord]]]:
    """At most `SHOWN` trials in their order by scenario or level: what went wrong comes first.

    `notes` are the domain's, by scenario. A chapter has its title, its note or "", its trials.
    """
    failed = pl.col("outcome").is_in(FAILURES) | ~pl.col("achieved")
    numbered = trials.with_row_index("number")
    chosen = pl.concat([numbered.filter(failed), numbered.filter(~failed)]).head(SHOWN)
    places = chosen.sort("number").drop("number").partition_by("scenario", "level")
    for told in places:
        scenario, level = told.select("scenario", "level").row(0)
        note = notes.get(scenario, "") if level == COARSE else ""
        yield of_place(scenario, level), note, list(records_of(told))


def command_of(folder: Path, trial: str) -> str:
    """The command that replays a trial."""
    return f"testbed replay {shlex.quote(str(folder))} --trial {trial}"


def slowest(trials: pl.DataFrame) -> list[TrialRecord]:
    """The trials with most reasoning, the slowest first."""
    ordered = trials.sort("reasoning_time_s", descending=True, maintain_order=True)
    return list(records_of(ordered.head(SLOWEST)))


class Ending(NamedTuple):
    """How trials of a robot ended that were not correct; `lost`: without it, or in an error."""

    place: str
    robot: str
    ending: str
    lost: bool


def failures(trials: pl.DataFrame) -> list[tuple[Ending, list[TrialRecord]]]:
    """Every trial that is not correct, by place, robot and ending; lost ones and errors first."""
    groups: dict[Ending, list[TrialRecord]] = {}
    for record in records_of(trials.filter(WRONG)):
        place, lost = of_place(record.scenario, record.level), record.outcome in FAILURES
        ending = Ending(place, record.robot, _ending(record), lost)
        groups.setdefault(ending, []).append(record)
    return sorted(groups.items(), key=lambda group: not group[0].lost)


def _ending(record: TrialRecord) -> str:
    if record.outcome == "achieved":
        return "achieved, not with the fewest actions"
    reach = ", out of reach" if record.in_reach is False else ""
    reason = f": {record.reason}" if record.outcome in FAILURES and record.reason else ""
    return f"{in_words(record.outcome)}{reach}{reason}"


@dataclass(frozen=True)
class Account:
    """An explanation, and how often it was adopted.

    `happened` is what others had done by then without telling.
    """

    happened: str
    explained: str
    count: int

    @property
    def right(self) -> bool:
        """Whether the explanation names just what happened, whatever the steps."""
        return self.happened == self.explained


@dataclass(frozen=True)
class Accounts:
    """The explanations of one robot: the most frequent ones, and how many there are in all."""

    robot: str
    total: int
    right: int
    common: list[Account]
    kinds: int


def accounts_of(records: Iterable[TrialRecord]) -> Iterator[Accounts]:
    """What each robot explained by what, in the order in which records name the robots."""
    counts: dict[str, Counter[tuple[str, str]]] = {}
    for record in records:
        own = counts.setdefault(record.robot, Counter())
        own.update((_happened(record, e.step), _assumed(e)) for e in record.explanations)
    for robot, own in counts.items():
        ordered = sorted(own.items(), key=lambda item: (-item[1], item[0]))
        told = [Account(*names, count) for names, count in ordered]
        right = sum(account.count for account in told if account.right)
        if told:
            yield Accounts(robot, own.total(), right, told[:MOST], len(told))


def _happened(record: TrialRecord, step: int) -> str:
    """What others had done before a step, and the robot was not told of."""
    unseen = (e.action for e in record.exogenous if e.step < step and not e.observed)
    return " ".join(sorted(unseen)) or NOTHING


def _assumed(explained: Explained) -> str:
    """Exceptions first, then what others did, then what is distrusted, whatever they are called."""
    exceptions = sorted(map(exception, explained.exceptions))
    events = sorted(event.action for event in explained.unobserved)
    distrusted = sorted(f"distrusted {report.action}" for report in explained.distrusted)
    outcomes = sorted(f"another outcome of {own.action}" for own in explained.outcomes)
    return " ".join([*exceptions, *events, *distrusted, *outcomes]) or NOTHING
