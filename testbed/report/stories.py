"""Single trials: step by step, the slowest, those that were not correct, and what was explained."""

import shlex
from collections import Counter
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass
from itertools import chain
from pathlib import Path
from typing import Any, NamedTuple

import polars as pl

from testbed.analysis.table import BATCH, Trials, records_of
from testbed.experiment.record import COARSE, FAILURES, TrialRecord
from testbed.experiment.timeline import exception, in_words, of_place

SHOWN = 60
"""Trials told step by step; of a larger run those that failed come first."""
LISTED = 60
"""Trials of one ending that are listed."""
SLOWEST = 10
ENDED = ("scenario", "level", "robot", "outcome", "in_reach", "reason")
"""Columns that say how a trial ended."""
MOST = 12
"""Explanations of a robot that are shown."""
NOTHING = "nothing"
WRONG = pl.col("correct").fill_null(True).not_() | pl.col("outcome").is_in(FAILURES)
"""Of the trials that are told as failures: all others are passed over."""


def chapters(
    trials: Trials, notes: Mapping[str, str]
) -> Iterator[tuple[str, str, list[TrialRecord]]]:
    """At most `SHOWN` trials in their order by scenario or level: what went wrong comes first.

    `notes` are the domain's, by scenario. A chapter has its title, its note or "", its trials.
    """
    failed = pl.col("outcome").is_in(FAILURES) | ~pl.col("achieved")
    known = trials.lazy().select("trial", failed=failed).collect()
    ordered = known.sort(~pl.col("failed"), maintain_order=True)
    places: dict[tuple[str, str], list[TrialRecord]] = {}
    for record in _records(trials, ordered.head(SHOWN)["trial"]):
        places.setdefault((record.scenario, record.level), []).append(record)
    for (scenario, level), told in places.items():
        note = notes.get(scenario, "") if level == COARSE else ""
        yield of_place(scenario, level), note, told


def _records(trials: Trials, chosen: pl.Series) -> Iterator[TrialRecord]:
    """Those of the trials with these ids, in the order of the table."""
    return records_of(trials.lazy().filter(pl.col("trial").is_in(chosen.to_list())))


def command_of(folder: Path, trial: str) -> str:
    """The command that replays a trial."""
    return f"testbed replay {shlex.quote(str(folder))} --trial {trial}"


def serving_command(folders: Iterable[Path]) -> str:
    """The command that serves all trials of these runs."""
    return shlex.join(["testbed", "report", "--serve", *map(str, folders)])


def slowest(trials: Trials) -> list[TrialRecord]:
    """The trials with most reasoning, the slowest first."""
    times = trials.lazy().select("trial", "reasoning_time_s").collect()
    ordered = times.sort("reasoning_time_s", descending=True, maintain_order=True)
    found = _records(trials, ordered.head(SLOWEST)["trial"])
    return sorted(found, key=lambda record: -record.reasoning_time_s)


class Ending(NamedTuple):
    """How trials of a robot ended that were not correct; `lost`: without it, or in an error."""

    place: str
    robot: str
    ending: str
    lost: bool


class Failed(NamedTuple):
    """A trial that was not correct, and what others did in it, in words."""

    trial: str
    events: str


def failures(trials: Trials) -> list[tuple[Ending, int, list[Failed]]]:
    """How many trials are not correct, by place, robot and ending; lost ones and errors first.

    At most `LISTED` of each are told: those of the first pairs, which a sample has first, too.
    """
    wrong = trials.lazy().filter(WRONG)
    first = pl.col("trial").sort_by("pair", "trial").head(LISTED)
    counts: Counter[Ending] = Counter()
    chosen: dict[Ending, list[str]] = {}
    for row in _rows(wrong.group_by(*ENDED, maintain_order=True).agg(pl.len(), first)):
        place, lost = of_place(row["scenario"], row["level"]), row["outcome"] in FAILURES
        ending = Ending(place, row["robot"], _ending(row), lost)
        counts[ending] += row["len"]
        chosen[ending] = [*chosen.get(ending, ()), *row["trial"]][:LISTED]
    ids = [*chain.from_iterable(chosen.values())]
    told = wrong.filter(pl.col("trial").is_in(ids)).select("trial", "exogenous")
    events = {row["trial"]: _events(row) for row in _rows(told)}
    groups = [
        (ending, counts[ending], [Failed(trial, events[trial]) for trial in listed])
        for ending, listed in chosen.items()
    ]
    return sorted(groups, key=lambda group: not group[0].lost)


def _events(row: Mapping[str, Any]) -> str:
    return ", ".join(f"{own['action']} at step {own['step']}" for own in row["exogenous"])


def _rows(query: pl.LazyFrame) -> Iterator[Mapping[str, Any]]:
    """The rows of a query, few at a time."""
    for piece in query.collect_batches(chunk_size=BATCH, maintain_order=True):
        yield from piece.iter_rows(named=True)


def _ending(row: Mapping[str, Any]) -> str:
    if row["outcome"] == "achieved":
        return "achieved, not with the fewest actions"
    reach = ", out of reach" if row["in_reach"] is False else ""
    reason = f": {row['reason']}" if row["outcome"] in FAILURES and row["reason"] else ""
    return f"{in_words(row['outcome'])}{reach}{reason}"


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


def accounts_of(trials: Trials) -> Iterator[Accounts]:
    """What each robot explained by what, in the order in which trials name the robots."""
    explaining = trials.lazy().filter(pl.col("explanations").list.len() > 0)
    counts: dict[str, Counter[tuple[str, str]]] = {}
    for row in _rows(explaining.select("robot", "exogenous", "explanations")):
        own = counts.setdefault(row["robot"], Counter())
        own.update((_happened(row, e["step"]), _assumed(e)) for e in row["explanations"])
    for robot, own in counts.items():
        ordered = sorted(own.items(), key=lambda item: (-item[1], item[0]))
        told = [Account(*names, count) for names, count in ordered]
        right = sum(account.count for account in told if account.right)
        if told:
            yield Accounts(robot, own.total(), right, told[:MOST], len(told))


def _happened(row: Mapping[str, Any], step: int) -> str:
    """What others had done before a step, and the robot was not told of."""
    unseen = (e["action"] for e in row["exogenous"] if e["step"] < step and not e["observed"])
    return " ".join(sorted(unseen)) or NOTHING


def _assumed(explained: Mapping[str, Any]) -> str:
    """Exceptions first, then what others did, then what is distrusted, whatever they are called."""
    exceptions = sorted(map(exception, explained["exceptions"]))
    events = sorted(event["action"] for event in explained["unobserved"])
    distrusted = sorted(f"distrusted {report['action']}" for report in explained["distrusted"])
    outcomes = sorted(f"another outcome of {own['action']}" for own in explained["outcomes"])
    return " ".join([*exceptions, *events, *distrusted, *outcomes]) or NOTHING
