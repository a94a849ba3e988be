"""`report.html`: one file without network, made again from the stored records at any time."""

from __future__ import annotations

import shlex
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path

from jinja2 import Environment, PackageLoader, StrictUndefined, Template
from markupsafe import Markup

from asp.commentary import scenario_notes
from asp.loading import read_domain
from testbed.config import ExperimentConfig
from testbed.experiment.comparison import comparisons
from testbed.experiment.record import FAILURES, TrialRecord
from testbed.experiment.store import REPORT, read_records, replace_text
from testbed.experiment.summary import write_summary
from testbed.experiment.tables import COLUMNS, Row, rows_of
from testbed.experiment.wording import counted, explanation, in_words

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
    """The told trials of a scenario; `note` is what the domain says of it, or ""."""

    scenario: str
    note: str
    stories: tuple[Story, ...]


def write_report(folder: Path, config: ExperimentConfig) -> list[Row]:
    """Write `summary.json` and `report.html` from the records of a run; the rows of its table."""
    summary = write_summary(folder)
    rows = rows_of(read_records(folder))
    chapters = list(_chapters(folder, scenario_notes(*reversed(read_domain(config.domain)))))
    page = _template().render(
        config=config,
        domain=Path(config.domain).stem,
        columns=COLUMNS,
        rows=rows,
        comparisons=comparisons(summary),
        trials=sum(row.trials for row in rows),
        told=sum(len(chapter.stories) for chapter in chapters),
        chapters=chapters,
        folder=shlex.quote(str(folder)),
    )
    replace_text(folder / REPORT, page)
    return rows


def _chapters(folder: Path, notes: Mapping[str, str]) -> Iterator[Chapter]:
    stories: dict[str, list[Story]] = {}
    for record in _worth_telling(folder):
        story = Story(record, tuple(timeline(record)))
        stories.setdefault(record.scenario, []).append(story)
    for scenario, told in stories.items():
        yield Chapter(scenario, notes.get(scenario, ""), tuple(told))


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


def _atoms(text: str) -> Markup:
    """Text that breaks at its spaces alone, and not inside of an atom."""
    return Markup(" ").join(Markup('<span class="atom">{}</span>').format(a) for a in text.split())


def _template() -> Template:
    loader = PackageLoader("testbed.experiment", "templates")
    environment = Environment(loader=loader, autoescape=True, undefined=StrictUndefined)
    environment.filters |= {"atoms": _atoms, "counted": counted, "in_words": in_words}
    environment.trim_blocks = environment.lstrip_blocks = True
    return environment.get_template("report.html.j2")
