"""`report.html`: one file without network, made again from the stored records at any time."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from asp.language import read_domain, scenario_notes
from testbed.analysis import Run
from testbed.analysis.condition import condition
from testbed.analysis.counting import Apart, eventful, pairs_apart
from testbed.analysis.summary import write_summary
from testbed.analysis.table import table_of
from testbed.config import ExperimentConfig
from testbed.experiment.coverage import coverage_of
from testbed.experiment.store import REPORT, read_records, replace_text
from testbed.report.comparison import OPTIMUM, charts, comparisons, optima
from testbed.report.rendering import environment, rendered
from testbed.report.stories import accounts_of, chapters, command_of, failures, slowest
from testbed.report.tables import Row, headings, rows_of
from testbed.studies import Results, Section, grid, left_out, results_of
from testbed.text.grid import Grid

COUNTED = ("achieved", "failed", "lost")
SAID = ("digest", "notice", "condition", "left_out")


@dataclass(frozen=True)
class Tables:
    """What a run comes to: a row a scenario (or level) and robot, and the tables of its studies.

    `digest` is the one number for all of its results but those of the `late` trials, which have a
    deadline; `notice` is what is to be known of a run that is not complete; `condition` is that of
    its trials in words, `left_out` says why published figures do not stand beside them, where they
    might.
    """

    digest: str
    late: int
    notice: str | None
    rows: list[Row]
    grids: list[Grid]
    condition: str = ""
    left_out: str | None = None


def write_report(folder: Path, config: ExperimentConfig) -> Tables:
    """Write `summary.json` and `report.html` from the records of a run; its tables."""
    run = Run(folder, config, {}, table_of(read_records(folder)))
    found, sure = results_of(run), eventful(config)
    covered = coverage_of(read_records(folder), config)
    summary = write_summary(folder, covered.numbers(), sure, [own.numbers for own in found])
    apart = pairs_apart(read_records(folder), sure)
    sections = [section for own in found for section in own.sections]
    tables = Tables(
        summary["digest"],
        sum(record.deadline for record in read_records(folder)),
        covered.notice(),
        rows_of(read_records(folder), apart),
        list(_grids(sections)),
        condition(config),
        left_out(config),
    )
    _write_page(folder, config, tables, sections, _compared(folder, found, summary, apart))
    return tables


def _grids(sections: Sequence[Section]) -> Iterator[Grid]:
    for section in sections:
        for view in (own for own in section.views if own.lines):
            yield grid(view, f"{section.title}: {view.title}")


def _write_page(
    folder: Path,
    config: ExperimentConfig,
    tables: Tables,
    sections: Sequence[Section],
    compared: Mapping[str, Any],
) -> None:
    parts = {
        **_heading(config, tables),
        "columns": headings(tables.rows),
        "rows": tables.rows,
        "sections": [(section, rendered(section)) for section in sections],
        **compared,
        **_trials(folder, config),
        "replay": lambda trial: command_of(folder, trial),
    }
    replace_text(folder / REPORT, environment().get_template("page.html.j2").render(parts))


def _heading(config: ExperimentConfig, tables: Tables) -> dict[str, Any]:
    return {
        "config": config,
        "domain": Path(config.domain).stem,
        "trials": sum(row.trials + row.lost for row in tables.rows),
        **{key: sum(getattr(row, key) for row in tables.rows) for key in COUNTED},
        **{key: getattr(tables, key) for key in SAID},
    }


def _compared(
    folder: Path, found: Sequence[Results], summary: Mapping[str, Any], apart: Mapping[str, Apart]
) -> dict[str, Any]:
    """How the robots compare, unless a study has that."""
    own = not any(finding.study.compares for finding in found)
    rows = comparisons(summary) if own else []
    several = any(group["pairs"] > 1 for group in summary["scenarios"].values())
    return {
        "comparisons": rows,
        "compared_charts": charts(read_records(folder), apart) if rows and several else [],
        "optimum_columns": OPTIMUM,
        "optima": optima(summary) if own else [],
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
