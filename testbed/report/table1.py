"""Table 1 as the report shows it: each value with its interval, above the published one."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path

from testbed.analysis.condition import deviations
from testbed.analysis.counting import BASELINE, INTENTIONAL, eventful
from testbed.analysis.statistics import Estimate
from testbed.config import ExperimentConfig
from testbed.experiment.domains import load_world
from testbed.experiment.store import read_records
from testbed.experiment.wording import counted
from testbed.report.figures import Panel, Point, Series, estimated, forest
from testbed.report.svg import FIRST, PAPER, SECOND
from testbed.studies.table1 import optimum, times
from testbed.studies.table1.analysis import Analysis, Row, Table, analyse
from testbed.studies.table1.pairing import MEETINGS, pairs_of
from testbed.studies.table1.published import (
    ALL,
    HALF_CENT,
    HALF_PERCENT,
    MEASURES,
    PUBLISHED,
    SCENARIOS,
    Published,
)
from testbed.studies.table1.runs import PROTOCOL, minds_of
from testbed.studies.table1.table import HEADINGS, tests_of

ACCURACIES = ("TP correct", "ATI correct")
COLUMNS = ("scenario", "pairs", *HEADINGS, *ACCURACIES)
TESTS = ("scenario", *HEADINGS, "correct")
OPTIMUM = optimum.COLUMNS
TIMES = times.COLUMNS
TRIGGERED, RANDOM = "triggered", "drawn at random, classified"


@dataclass(frozen=True)
class Value:
    """A cell: ours, its interval, the published value, and whether the interval holds that."""

    ours: str
    interval: str = ""
    published: str = ""
    inside: bool | None = None


@dataclass(frozen=True)
class Line:
    """A row of the table."""

    name: str
    pairs: int
    values: tuple[Value, ...]


@dataclass(frozen=True)
class View:
    """One way of assigning pairs to scenarios; `notes` say what is in no row, and how pairs met."""

    title: str
    lines: tuple[Line, ...]
    tests: tuple[tuple[str, ...], ...]
    optimum: tuple[tuple[str, ...], ...]
    times: tuple[tuple[str, ...], ...]
    notes: tuple[str, ...]


def analyses(folder: Path, config: ExperimentConfig) -> list[Analysis]:
    """Each robot with activities against the traditional one; nothing for another protocol."""
    if config.protocol != PROTOCOL:
        return []
    world, sure = load_world(config.domain), eventful(config)
    found = [
        analyse(pairs_of(read_records(folder), world, mind, BASELINE), mind, BASELINE, sure)
        for mind in minds_of(config)
    ]
    return [_beside_the_paper(own, config) for own in found]


def _beside_the_paper(analysis: Analysis, config: ExperimentConfig) -> Analysis:
    """The same with the published figures of what was played as it was for them.

    The figures of all scenarios together are those of five of them.
    """
    theirs = {} if deviations(config, PROTOCOL) or analysis.mind != INTENTIONAL else PUBLISHED
    whole = set(SCENARIOS) <= set(config.scenarios)
    parts = {name: row for name, row in theirs.items() if whole or not name.startswith(ALL)}
    triggered, random = analysis.triggered, analysis.random
    return replace(
        analysis,
        triggered=triggered and replace(triggered, published=parts),
        random=random and replace(random, published=theirs),
    )


def views(analysis: Analysis) -> list[View]:
    """The tables of two robots, those without pairs left out."""
    both = ((TRIGGERED, analysis.triggered), (RANDOM, analysis.random))
    return [
        View(
            title,
            tuple(_lines(table)),
            tuple(tests_of(table)),
            tuple(optimum.rows_of(table, analysis.mind, analysis.base)),
            tuple(times.rows_of(table)),
            tuple(_notes(table)),
        )
        for title, table in both
        if table is not None
    ]


def _lines(table: Table) -> Iterator[Line]:
    for row in table.rows:
        if row.pairs:
            yield Line(row.name, row.pairs, tuple(_values(row, table.published.get(row.name))))


def _values(row: Row, paper: Published | None) -> Iterator[Value]:
    for measure in MEASURES:
        published = None if paper is None else paper.ratios[measure]
        yield _value(row.ratios[measure].mean, published, "{:.2f}", HALF_CENT)
    shares = (row.baseline, row.intentional)
    theirs = (None, None) if paper is None else (paper.baseline, paper.intentional)
    for share, published in zip(shares, theirs, strict=True):
        yield _value(share, published, "{:.0%}", HALF_PERCENT, "{:.1%}")


def _value(
    ours: Estimate | None, published: float | None, form: str, half_digit: float, finer: str = ""
) -> Value:
    """Ours in the form of the published one, unless with another decimal."""
    theirs = "" if published is None else form.format(published)
    form = finer or form
    if ours is None:
        return Value("-", "", theirs)
    interval = "" if ours.single else f"{form.format(ours.low)} to {form.format(ours.high)}"
    inside = None if published is None else ours.covers(published, half_digit)
    return Value(form.format(ours.value), interval, theirs, inside)


def _notes(table: Table) -> Iterator[str]:
    everything = [row for row in table.rows if row.name.isdigit()]
    apart = [f"{counted(number, 'pair')} of {name}" for name, number in table.apart.items()]
    keys = ("lost", "late", "unsolvable")
    lost, late, never = (sum(getattr(row, key) for row in everything) for key in keys)
    apart += [f"{counted(lost, 'pair')} with a lost trial"] * (lost > 0)
    apart += [f"{counted(late, 'pair')} with a decision cut off by the clock"] * (late > 0)
    apart += [f"{counted(never, 'pair')} whose goal no plan achieves"] * (never > 0)
    undecided = sum(row.undecided for row in everything)
    if undecided:
        yield f"In no accuracy: {counted(undecided, 'pair')} whose fewest actions are not known"
    if apart:
        yield f"In no row: {', '.join(apart)}"
    for meeting, words in MEETINGS.items():
        number = sum(row.meetings.get(meeting, 0) for row in everything)
        if number:
            yield f"{counted(number, 'pair')}: {words}"


def panels(analysis: Analysis) -> list[Panel]:
    """Accuracies and ratios with intervals by scenario, both tables and the published one."""
    rows = [name for name in PUBLISHED if any(_row(t, name) for t in _tables(analysis))]
    name = analysis.mind
    shares = (("baseline", ACCURACIES[0]), ("intentional", ACCURACIES[1]))
    found = [
        forest(f"{name}-{who}", title, rows, _share_series(analysis, rows, who), share=True)
        for who, title in shares
    ]
    return found + [
        forest(f"{name}-{m}", f"{title}, TP / ATI", rows, _ratio_series(analysis, rows, m))
        for m, title in zip(MEASURES, HEADINGS, strict=True)
    ]


def _tables(analysis: Analysis) -> list[Table]:
    return [table for table in (analysis.triggered, analysis.random) if table is not None]


def published_in(analysis: Analysis) -> Mapping[str, Published]:
    """The rows of the paper that an analysis is to be compared with, by name."""
    return {name: row for table in _tables(analysis) for name, row in table.published.items()}


def _row(table: Table | None, name: str) -> Row | None:
    rows = () if table is None else table.rows
    return next((row for row in rows if row.name == name and row.pairs), None)


def _ratio_series(analysis: Analysis, rows: Sequence[str], measure: str) -> list[Series]:
    def ours(row: Row) -> Estimate | None:
        return row.ratios[measure].mean

    known = published_in(analysis)
    paper = tuple(Point(name, known[name].ratios[measure]) for name in rows if name in known)
    return _series(analysis, rows, ours, paper)


def _share_series(analysis: Analysis, rows: Sequence[str], who: str) -> list[Series]:
    def ours(row: Row) -> Estimate | None:
        share: Estimate | None = getattr(row, who)
        return share

    known = published_in(analysis)
    paper = tuple(Point(name, getattr(known[name], who)) for name in rows if name in known)
    return _series(analysis, rows, ours, paper)


def _series(
    analysis: Analysis,
    rows: Sequence[str],
    ours: Callable[[Row], Estimate | None],
    paper: tuple[Point, ...],
) -> list[Series]:
    triggered = _points(analysis.triggered, rows, ours)
    random = _points(analysis.random, rows, ours)
    return [
        Series(TRIGGERED, FIRST, triggered),
        Series(RANDOM, SECOND, random, marker="s"),
        *[Series("published", PAPER, paper, marker="D", published=True)] * bool(paper),
    ]


def _points(
    table: Table | None, rows: Sequence[str], ours: Callable[[Row], Estimate | None]
) -> tuple[Point, ...]:
    known = ((name, _row(table, name)) for name in rows)
    estimates = ((name, ours(row)) for name, row in known if row is not None)
    return tuple(estimated(name, own) for name, own in estimates if own is not None)
