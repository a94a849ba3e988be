"""`report.html`: one file without network, made again from the stored records at any time."""

# Figures and the statistics of a published table take a second to import, and few runs have them.
# ruff: noqa: PLC0415

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING, Any

from asp.language import read_domain, scenario_notes
from testbed.analysis.condition import condition, left_out
from testbed.analysis.counting import Apart, eventful, pairs_apart
from testbed.analysis.summary import write_summary
from testbed.config import ExperimentConfig
from testbed.experiment.coverage import coverage_of
from testbed.experiment.store import REPORT, read_records, replace_text
from testbed.report.accounts import accounts_of
from testbed.report.comparison import OPTIMUM, comparisons, optima
from testbed.report.endings import command_of, failures, slowest
from testbed.report.rendering import environment
from testbed.report.stories import chapters
from testbed.report.tables import Row, headings, rows_of
from testbed.studies.levels.protocol import paper_of
from testbed.studies.levels.results import levels_of
from testbed.studies.levels.table import LevelTable, level_tables

if TYPE_CHECKING:
    from testbed.studies.table1.analysis import Analysis

PROTOCOL = "table1"


@dataclass(frozen=True)
class Tables:
    """What a run comes to: a row a scenario (or level) and robot, and the published tables.

    `digest` is the one number for all of its results but those of the `late` trials, which have a
    deadline; `notice` is what is to be known of a run that is not complete; `condition` is that of
    its trials in words, `left_out` says why published figures do not stand beside them, where they
    might.
    """

    digest: str
    late: int
    notice: str | None
    rows: list[Row]
    levels: list[LevelTable]
    table1: list[Analysis] = field(default_factory=list)
    condition: str = ""
    left_out: str | None = None


def write_report(folder: Path, config: ExperimentConfig) -> Tables:
    """Write `summary.json` and `report.html` from the records of a run; its tables."""
    table1, sure, paper = _table1(folder, config), eventful(config), paper_of(config)
    covered = coverage_of(read_records(folder), config)
    summary = write_summary(folder, covered.numbers(), sure, _numbers(table1), paper)
    apart = pairs_apart(read_records(folder), sure)
    rows = rows_of(read_records(folder), apart)
    levels = level_tables(levels_of(summary), paper)
    tables = Tables(
        str(summary["digest"]),
        sum(record.deadline for record in read_records(folder)),
        covered.notice(),
        rows,
        levels,
        table1,
        condition(config),
        left_out(config),
    )
    parts = {
        **_heading(config, tables),
        **_tables(config, tables, summary),
        **_compared(folder, tables, summary, apart),
        **_trials(folder, config),
        "replay": lambda trial: command_of(folder, trial),
    }
    replace_text(folder / REPORT, environment().get_template("page.html.j2").render(parts))
    return tables


def _table1(folder: Path, config: ExperimentConfig) -> list[Analysis]:
    if config.protocol != PROTOCOL:
        return []
    from testbed.report.table1 import analyses

    return analyses(folder, config)


def _numbers(analyses: Sequence[Analysis]) -> dict[str, object]:
    """The published table's part of the summary."""
    if not analyses:
        return {}
    from testbed.studies.table1.numbers import numbers

    return {PROTOCOL: numbers(analyses)}


def _heading(config: ExperimentConfig, tables: Tables) -> dict[str, Any]:
    return {
        "config": config,
        "domain": Path(config.domain).stem,
        "trials": sum(row.trials + row.lost for row in tables.rows),
        "achieved": sum(row.achieved for row in tables.rows),
        "failed": sum(row.failed for row in tables.rows),
        "lost": sum(row.lost for row in tables.rows),
        "digest": tables.digest,
        "notice": tables.notice,
        "condition": tables.condition,
        "left_out": tables.left_out,
    }


def _tables(config: ExperimentConfig, tables: Tables, summary: Mapping[str, Any]) -> dict[str, Any]:
    return {
        "columns": headings(tables.rows),
        "rows": tables.rows,
        **(_levels(config, summary) if tables.levels else {"levels": []}),
        "published": [_published(analysis) for analysis in tables.table1],
    }


def _compared(
    folder: Path, tables: Tables, summary: Mapping[str, Any], apart: Mapping[str, Apart]
) -> dict[str, Any]:
    """The published experiment has a table of its own for it."""
    rows = [] if tables.table1 else comparisons(summary)
    several = any(group["pairs"] > 1 for group in summary["scenarios"].values())
    panels = _compared_panels(folder, apart) if rows and several else []
    distances = [] if tables.table1 else optima(summary)
    return {
        "comparisons": rows,
        "compared_panels": panels,
        "optimum_columns": (headings(tables.rows)[0], *OPTIMUM),
        "optima": distances,
    }


def _compared_panels(folder: Path, apart: Mapping[str, Apart]) -> list[Any]:
    from testbed.report.compared import panels

    return panels(read_records(folder), apart)


def _levels(config: ExperimentConfig, summary: Mapping[str, Any]) -> dict[str, Any]:
    from testbed.report.level_panels import panels, ratio_panels
    from testbed.report.levels import TESTS, effect_rows, views

    levels, paper = levels_of(summary), paper_of(config)
    return {
        "levels": views(levels, paper),
        "level_panels": [*panels(levels, paper), *ratio_panels(levels, paper)],
        "level_paper": bool(paper.conditions),
        "level_tests": (TESTS, list(effect_rows(levels))),
    }


def _published(analysis: Analysis) -> dict[str, Any]:
    from testbed.report import table1

    return {
        "robot": analysis.mind,
        "paper": bool(table1.published_in(analysis)),
        "columns": table1.COLUMNS,
        "tests": table1.TESTS,
        "optimum": table1.OPTIMUM,
        "times": table1.TIMES,
        "views": table1.views(analysis),
        "panels": table1.panels(analysis),
        "became": analysis.became,
    }


def _trials(folder: Path, config: ExperimentConfig) -> dict[str, Any]:
    source = reversed(read_domain(config.domain))
    told = list(chapters(folder, scenario_notes(*source) if config.plays_triggers else {}))
    return {
        "accounts": accounts_of(read_records(folder)),
        "slowest": slowest(read_records(folder), folder),
        "failures": failures(read_records(folder), folder),
        "told": sum(len(chapter.stories) for chapter in told),
        "chapters": told,
    }
