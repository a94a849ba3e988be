"""`docs/levels-published-and-measured.md`: Tables 2 and 3 beside ours, and what explains them."""

from collections.abc import Iterator
from typing import Any

from papers.commands import workers_of
from papers.levels import evidence
from papers.levels.commands import commands, place
from papers.levels.differing import differences, growth
from papers.levels.pairing import MEETINGS
from papers.levels.runs import Run
from papers.text import render
from testbed.experiment.digest import digest
from testbed.experiment.plan import coverage_of, places_of
from testbed.experiment.store import read_records
from testbed.studies import Line, rows_of
from testbed.studies.levels import tables
from testbed.studies.levels.published import FIRST, NO_ZOOM, PARTS, ZOOM


def document(run: Run) -> str:
    """The page as Markdown: the tables, why ours differ, what both robots met, the tests."""
    values = {
        "commands": commands(run.folder, run.config),
        "digest": digest(read_records(run.folder)),
        "workers": workers_of(run.folder),
        "notice": coverage_of(places_of(run.folder), run.config).notice(),
        "place": place(run.config),
        "first": FIRST,
        **_compared(run),
        **differences(run),
        **growth(run),
        **_meetings(run),
        **_failures(run),
    }
    return render("levels/page", **values)


def _compared(run: Run) -> dict[str, Any]:
    """The tables of ours beside the published values, and that of the tests."""
    return {
        "headings": tables.HEADINGS,
        "ratio_columns": tables.RATIOS,
        "growth_columns": tables.GROWTH,
        "test_columns": tables.TESTS,
        "shares": [_share(row) for row in tables.shares(run.beside)],
        "ratios": list(rows_of(row.line for row in tables.ratios(run.beside))),
        "growth": list(rows_of(row.line for row in tables.growth(run.beside))),
        "seconds": list(rows_of(_seconds(run))),
        "tests": list(tables.effect_rows(run.levels)),
    }


def _share(row: tables.Row) -> tuple[str, ...]:
    """With the published value in a column of its own."""
    (value,) = row.line.values
    return (*row.line.labels, value.whole, value.marked or "-")


def _seconds(run: Run) -> Iterator[Line]:
    for name, level in run.levels.items():
        for robot, own in level.reasoning.items():
            achieved = f"{own.achieved}/{own.trials}{tables.out_of_reach(own)}"
            theirs = [run.beside.paper.seconds(name, robot, part) for part in PARTS]
            times = (
                tables.timed(getattr(own, part), paper)
                for part, paper in zip(PARTS, theirs, strict=True)
            )
            yield Line((name, tables.CONDITIONS.get(robot, robot), achieved), tuple(times))


def _meetings(run: Run) -> dict[str, Any]:
    """Whether the robots of a pair met the same, in all pairs and by level."""
    whole = evidence.met(run.all_pairs)
    levels = {name: evidence.met(own) for name, own in run.pairs.items()}
    rows = [
        (text, *(str(own.meetings[kind]) for own in (*levels.values(), whole)))
        for kind, text in MEETINGS.items()
    ]
    return {"met": whole, "levels": tuple(levels), "meetings": rows}


def _failures(run: Run) -> dict[str, Any]:
    """The trials that were not correct; how many ended otherwise than by their robot."""
    trials = [
        (pair.level, tables.CONDITIONS[robot], trial)
        for pair in run.all_pairs
        for robot, trial in ((ZOOM, pair.zoom), (NO_ZOOM, pair.no_zoom))
    ]
    return {
        "trials": len(trials),
        "lost": sum(not trial.ended for _, _, trial in trials),
        "out_of_reach": sum(trial.out_of_reach for _, _, trial in trials),
        "wrong": [
            {"level": level, "condition": who, "trial": own.trial, "outcome": own.outcome}
            for level, who, own in trials
            if own.decided and not own.correct
        ],
    }
