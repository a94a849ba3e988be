"""Trials told step by step: of a large run some, those that went wrong first."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path

from testbed.experiment.record import COARSE, FAILURES, TrialRecord
from testbed.experiment.store import read_records
from testbed.experiment.wording import explanation, of_place

SHOWN = 60  # trials told step by step; of a larger run those that failed come first


@dataclass(frozen=True)
class Step:
    """A line of a trial's timeline; `kind` is how it is coloured."""

    number: int
    kind: str
    robot: str
    others: str
    explained: str


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


def chapters(folder: Path, notes: Mapping[str, str]) -> Iterator[Chapter]:
    """The told trials of a run by scenario or level; `notes` are the domain's, by scenario."""
    stories: dict[tuple[str, str], list[Story]] = {}
    for record in _worth_telling(folder):
        story = Story(record, tuple(timeline(record)))
        stories.setdefault((record.scenario, record.level), []).append(story)
    for (scenario, level), told in stories.items():
        note = notes.get(scenario, "") if level == COARSE else ""
        yield Chapter(of_place(scenario, level), note, tuple(told))


def timeline(record: TrialRecord) -> Iterator[Step]:
    """The steps of a trial: what the robot did, what others did, what the robot explained.

    At the fine resolution those alone at which something begins or is heard of.
    """
    attempts = {attempt.step: attempt for attempt in record.actions}
    mental = {item.step: item.action for item in record.mental}
    others = {item.step: item for item in record.exogenous}
    explanations = {item.step: item for item in record.explanations}
    rejected = {item.step: f"{item.action}, not possible" for item in record.rejected}
    told = {*rejected, *attempts, *mental, *others, *explanations}
    for number in range(1, record.steps + 1):
        attempt, event = attempts.get(number), others.get(number)
        if record.fine is not None and number not in told:
            continue
        if attempt is not None:
            kind = "done" if attempt.happened else "failed"
            robot = attempt.action if attempt.happened else f"{attempt.action} failed"
        else:
            kind = "mental"
            robot = mental.get(number, "wait")
        unseen = "" if event is None or event.observed else ", unseen"
        seen = rejected.get(number, "") if event is None else f"{event.action}{unseen}"
        adopted = explanations.get(number)
        yield Step(number, kind, robot, seen, explanation(adopted) if adopted else "")


def _worth_telling(folder: Path) -> list[TrialRecord]:
    """At most `SHOWN` records, in their order: what went wrong first, then the others."""
    wrong = _some(r for r in read_records(folder) if _went_wrong(r))
    others = _some(r for r in read_records(folder) if not _went_wrong(r))
    chosen = {record.trial for record in [*wrong, *others][:SHOWN]}
    return [record for record in read_records(folder) if record.trial in chosen]


def _some(records: Iterable[TrialRecord]) -> list[TrialRecord]:
    return [record for record, _ in zip(records, range(SHOWN), strict=False)]


def _went_wrong(record: TrialRecord) -> bool:
    return record.outcome in FAILURES or not record.achieved
