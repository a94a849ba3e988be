"""`report.html`: one file without network, made again from the stored records at any time."""

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import polars as pl
from jinja2 import Environment, PackageLoader, StrictUndefined
from markupsafe import Markup

from asp.language import read_domain, scenario_notes
from testbed.analysis import Run
from testbed.analysis.comparison import COUNTS, MEASURES, compared, eventful, measured, with_apart
from testbed.analysis.condition import condition
from testbed.analysis.pairs import Compared
from testbed.analysis.run import run_of
from testbed.analysis.stored_table import Table, made_table, stored_table
from testbed.analysis.summary import write_summary
from testbed.config import ExperimentConfig
from testbed.experiment.plan import coverage_of
from testbed.experiment.run_folder import REPORT, replace_text
from testbed.experiment.specs import TrialSpec
from testbed.experiment.timeline import in_words, of_place, timeline
from testbed.report.catalogue import studies_of
from testbed.report.comparison import OPTIMUM, charts, groups_of, optima
from testbed.report.explanations import quality_table
from testbed.report.explorer import explorer_of, served_explorer
from testbed.report.stories import accounts_of, chapters, command_of, failures, slowest
from testbed.report.tables import Row, headings, rows_of
from testbed.studies import Chart, Results, Section, grid, left_out, results_of
from testbed.text import chance, counted, listed, number, plain, warn
from testbed.text.grid import Grid


@dataclass(frozen=True)
class Tables:
    """What a run comes to: one row per scenario or level and robot, and the tables of studies.

    `answers` are sentences, one per question that the run answers. `digest` is the one number for
    all of its results but those of the `late` trials, which have a deadline; `notice` is what is to
    be known of a run that is not complete; `condition` is that of its trials in words, `left_out`
    says why published figures do not stand beside them, where they might.
    """

    digest: str
    late: int
    answers: list[str]
    notice: str | None
    rows: list[Row]
    grids: list[Grid]
    condition: str = ""
    left_out: str | None = None


@dataclass(frozen=True)
class Report:
    """The report of a run: its tables, and what its page is made of."""

    run: Run
    tables: Tables
    parts: Mapping[str, Any]

    def page(self, served: bool = False) -> str:
        """The page, which holds some of the trials; one that is `served` asks for all of them."""
        explorer = served_explorer([self.run]) if served else explorer_of(self.run)
        return environment().get_template("page.html.j2").render(self.parts, explorer=explorer)


def write_report(
    folder: Path, config: ExperimentConfig, specs: Iterable[TrialSpec] | None = None
) -> Tables:
    """Write `summary.json` and `report.html` from the records of a run; its tables.

    The table of its trials is stored there, too. With `specs` records are to be those of these
    trials, which are the plan of the configuration. Raises StoreError for one that is not.
    """
    return written_report(folder, config, specs).tables


def written_report(
    folder: Path, config: ExperimentConfig, specs: Iterable[TrialSpec] | None = None
) -> Report:
    """The same; the whole report."""
    run = run_of(folder, config, _table(folder, config, specs))
    found = results_of(run)
    covered = coverage_of(run.table.select("scenario", "level").collect().iter_rows(), config)
    summary = write_summary(run, covered.numbers(), [own.numbers for own in found])
    main, *_ = compared(config)
    rows = with_apart(measured(run.table), main, eventful(config))
    sections = [section for own in found for section in own.sections]
    views = [(section, view) for section in sections for view in section.views if view.lines]
    tables = Tables(
        summary["digest"],
        summary["deadline"],
        [own["sentence"] for own in summary["answers"]],
        covered.notice(),
        rows_of(run.table, rows["apart"]),
        [grid(view, f"{section.title}: {view.title}") for section, view in views],
        condition(config),
        left_out(config),
    )
    report = Report(run, tables, _parts(run, tables, sections, _compared(rows, found, summary)))
    replace_text(folder / REPORT, report.page())
    return report


def _table(folder: Path, config: ExperimentConfig, specs: Iterable[TrialSpec] | None) -> Table:
    """The table of a run, stored if that is possible: a report can be made without."""
    try:
        return stored_table(folder, config, specs)
    except OSError as error:  # of writing: the records have been read, and checked
        warn(f"{error.filename}: {error.strerror}; each report reads all records")
        return made_table(folder).table


def page_of_several(reports: Sequence[Report]) -> str:
    """The page of several runs, with what each of them answers; it asks for the trials of all."""
    runs = [report.run for report in reports]
    notes = [{*report.parts["notes"].items()} for report in reports]
    values = {
        "reports": list(zip(studies_of(runs), reports, strict=True)),
        "notes": dict(set.intersection(*notes)),
        "chapters": [],
        "explorer": served_explorer(runs),
    }
    return environment().get_template("runs.html.j2").render(values)


def _parts(
    run: Run, tables: Tables, sections: Sequence[Section], compared: Mapping[str, Any]
) -> dict[str, Any]:
    source = reversed(read_domain(run.config.domain))
    notes = scenario_notes(*source) if run.config.plays_triggers else {}
    return {
        "config": run.config,
        "domain": Path(run.config.domain).stem,
        "tables": tables,
        "columns": headings(tables.rows),
        "sections": [(section, rendered(section)) for section in sections],
        **compared,
        "trials": sum(row.trials + row.lost for row in tables.rows),
        "accounts": list(accounts_of(run.table)),
        "slowest": slowest(run.table),
        "failures": failures(run.table),
        "notes": notes,
        "chapters": list(chapters(run.table, notes)),
        "replay": lambda trial: command_of(run.folder, trial),
    }


def _compared(
    trials: pl.DataFrame, found: Sequence[Results], summary: Mapping[str, Any]
) -> dict[str, Any]:
    """How the robots compare, unless a study has that."""
    own = not any(finding.study.compares for finding in found)
    groups = groups_of(summary) if own else {}
    several = any(group["pairs"] > 1 for group in summary["scenarios"].values())
    return {
        "compared": groups,
        "compared_charts": charts(trials, summary) if groups and several else [],
        **{role: summary[role] for role in Compared._fields},
        "counts": COUNTS,
        "measures": list(MEASURES),
        "exhaustive": summary["exhaustive"],
        "optimum_columns": OPTIMUM,
        "optima": optima(summary) if own else [],
        "quality": quality_table(summary),
    }


def rendered(section: Section) -> Markup:
    """A section of a study as HTML, by its own template where it has one."""
    made = environment()
    if section.template is None:
        template = made.get_template("section.html.j2")
    else:
        template = made.from_string(section.template.read_text(encoding="utf-8"))
    return Markup(template.render({"section": section, **(section.values or {})}))


def environment() -> Environment:
    """Templates in which text is escaped and a name that is not given is an error."""
    loader = PackageLoader("testbed.report", "templates")
    made = Environment(loader=loader, autoescape=True, undefined=StrictUndefined, finalize=_visible)
    made.filters |= {
        "atoms": _atoms,
        "chance": chance,
        "counted": counted,
        "drawn": _drawn,
        "in_words": in_words,
        "listed": listed,
        "number": number,
        "of_place": lambda own: of_place(own.scenario, own.level),
        "steps": lambda own: list(timeline(own)),
    }
    made.trim_blocks = made.lstrip_blocks = True
    return made


def _visible(value: object) -> object:
    """Text of users and robots without what would steer its direction; blanks may stay."""
    if isinstance(value, str) and not hasattr(value, "__html__"):
        return plain(value, keep="\n\r\t")
    return value


def _drawn(charts: Iterable[Chart]) -> list[Any]:
    """Charts as figures."""
    from testbed.report.figures import drawn  # noqa: PLC0415  # slow, and few runs have figures

    return list(map(drawn, charts))


def _atoms(text: str) -> Markup:
    """Text that breaks at its spaces alone, and not inside of an atom."""
    atoms = (Markup('<span class="atom">{}</span>').format(plain(atom)) for atom in text.split())
    return Markup(" ").join(atoms)
