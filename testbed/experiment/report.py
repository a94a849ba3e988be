"""`report.html`: one file without network, made again from the stored records at any time."""

from __future__ import annotations

import shlex
from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from pathlib import Path

from jinja2 import Environment, PackageLoader, StrictUndefined, Template

from testbed.experiment.record import FAILURES, TrialRecord
from testbed.experiment.store import REPORT, read_records, replace_text
from testbed.experiment.summary import write_summary
from testbed.experiment.tables import COLUMNS, Row, rows_of
from testbed.experiment.wording import explanation

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


def write_report(folder: Path, name: str) -> list[Row]:
    """Write `summary.json` and `report.html` from the records of a run; the rows of its table."""
    write_summary(folder)
    rows = rows_of(read_records(folder))
    stories = [Story(record, tuple(timeline(record))) for record in _worth_telling(folder)]
    page = _template().render(
        name=name,
        columns=COLUMNS,
        rows=rows,
        trials=sum(row.trials for row in rows),
        stories=stories,
        folder=shlex.quote(str(folder)),
    )
    replace_text(folder / REPORT, page)
    return rows


def timeline(record: TrialRecord) -> Iterator[Step]:
    """The steps of a trial: what the robot did, what others did, what the robot explained."""
    attempts = {attempt.step: attempt for attempt in record.actions}
    mental = {item.step: item.action for item in record.mental}
    others = {item.step: item for item in record.exogenous}
    explanations = {item.step: item for item in record.explanations}
    for number in range(1, record.steps + 1):
        attempt, event = attempts.get(number), others.get(number)
        if attempt is not None:
            kind = "done" if attempt.happened else "failed"
            robot = attempt.action if attempt.happened else f"{attempt.action} failed"
        else:
            kind = "mental"
            robot = mental.get(number, "wait")
        seen = "" if event is None else f"{event.action}{'' if event.observed else ', unseen'}"
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


def _template() -> Template:
    loader = PackageLoader("testbed.experiment", "templates")
    environment = Environment(loader=loader, autoescape=True, undefined=StrictUndefined)
    environment.trim_blocks = environment.lstrip_blocks = True
    return environment.get_template("report.html.j2")
