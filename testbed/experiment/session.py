"""A session of the command line over a run folder: run or go on, then tables and report."""

from __future__ import annotations

import shlex
from pathlib import Path
from typing import TYPE_CHECKING

from rich.console import Console

from testbed.config import ExperimentConfig
from testbed.experiment.coverage import coverage_of
from testbed.experiment.errors import WorkerError
from testbed.experiment.interrupts import INTERRUPTED, stoppable
from testbed.experiment.levels.table import rich_level_table
from testbed.experiment.progress import progress
from testbed.experiment.provenance import Provenance, session_arguments
from testbed.experiment.report import Tables, write_report
from testbed.experiment.runner import Tally, run_trials
from testbed.experiment.store import (
    CONFIG,
    REPORT,
    check_unchanged,
    choose_folder,
    holds_run,
    read_records,
    write_config,
)
from testbed.experiment.tables import rich_table
from testbed.experiment.wording import counted

if TYPE_CHECKING:
    from testbed.experiment.table1.analysis import Analysis

DONE, FAILED, BAD_INPUT = 0, 1, 2
WIDE, WIDEST = 120, 150


def run_session(
    config: ExperimentConfig,
    out: Path | None,
    workers: int | None,
    resume: bool,
    quiet: bool,
) -> int:
    """Run a configuration and report; the exit code.

    Raises:
        StoreError: before anything is run.
        WorkerError: where no trial can be played; what is on record stays.
    """
    folder = choose_folder(out, config.name, resume)
    console = _console(quiet)
    if resume and not holds_run(folder):
        _say(console, f"nothing to resume: a new run in {folder}")
    _prepare(folder, config)
    with stoppable(_to_go_on(folder), quiet):
        provenance = Provenance(folder, config, session_arguments())
        try:
            tally = _played(config, folder, workers, quiet)
        except WorkerError:
            provenance.close(BAD_INPUT, workers=0)
            raise
        code = _exit_code(tally)
        provenance.close(code, tally.workers)
        try:
            _conclude(folder, config, tally, console)
        except KeyboardInterrupt:  # the trials are on record, the report is not made
            _say(console, f"interrupted; for the report: testbed report {_quoted(folder)}")
            return INTERRUPTED
    return code


def report_again(folder: Path, config: ExperimentConfig) -> None:
    """Table, summary and report of a run, made again. Raises StoreError."""
    console = _console()
    _show(console, write_report(folder, config))
    _say(console, f"report: {folder / REPORT}")


def _console(quiet: bool = False) -> Console:
    """Standard output: as wide as the terminal, and wide where it is none."""
    console = Console(quiet=quiet)
    return console if console.is_terminal else Console(quiet=quiet, width=WIDE)


def _prepare(folder: Path, config: ExperimentConfig) -> None:
    if holds_run(folder):
        check_unchanged(folder, config)
    else:
        write_config(folder, config)


def _played(config: ExperimentConfig, folder: Path, workers: int | None, quiet: bool) -> Tally:
    try:
        with progress(quiet) as notify:
            return run_trials(config, folder, workers, notify)
    except KeyboardInterrupt:  # while the trials were planned: none was played
        covered = coverage_of(read_records(folder), config)
        planned = sum(covered.planned.values())
        done = planned - sum(covered.missing.values())
        return Tally(planned, done, failed=0, workers=0, interrupted=True)


def _exit_code(tally: Tally) -> int:
    if tally.interrupted:
        return INTERRUPTED
    return FAILED if tally.failed else DONE


def _conclude(folder: Path, config: ExperimentConfig, tally: Tally, console: Console) -> None:
    tables = write_report(folder, config)
    if tables.rows:
        _show(console, tables)
    if tally.interrupted:
        kept = f"{tally.done} of {counted(tally.planned, 'trial')}"
        _say(console, f"interrupted: {kept} kept in {folder}")
        _say(console, _to_go_on(folder))
        if not tables.rows:
            return
    if tally.failed:
        failed = counted(tally.failed, "trial")
        _say(console, f"{failed} ended in error or without a robot; see the report")
    _say(console, f"report: {folder / REPORT}")


def _show(console: Console, tables: Tables) -> None:
    if tables.rows:
        _show_tables(console, tables)
    if tables.notice is not None:
        _say(console, f"incomplete: {tables.notice}")
    if tables.rows:
        results = counted(sum(row.trials + row.lost for row in tables.rows), "trial")
        _say(console, f"digest of {results}: {tables.digest}")


def _show_tables(console: Console, tables: Tables) -> None:
    console.print(rich_table(tables.rows))
    for levels in tables.levels:
        console.print()
        console.print(rich_level_table(levels))
    for analysis in tables.table1:
        _show_table1(console, analysis)
    for row in tables.rows:
        for note in row.notes():
            _say(console, note)


def _show_table1(console: Console, analysis: Analysis) -> None:
    from testbed.experiment.table1.table import rich_table1  # noqa: PLC0415  # slow, and rare

    whom = f"Table 1, {analysis.mind} against {analysis.base}"
    both = (("triggered", analysis.triggered), ("random events, classified", analysis.random))
    width = None if console.is_terminal else WIDEST
    for kind, table in both:
        if table is not None:
            title = f"{whom}: {kind} (*: outside of our interval)"
            console.print()
            console.print(rich_table1(table, title), width=width)


def _to_go_on(folder: Path) -> str:
    where = _quoted(folder)
    return f"to go on: testbed run {_quoted(folder / CONFIG)} --out {where} --resume"


def _quoted(path: Path) -> str:
    return shlex.quote(str(path))


def _say(console: Console, line: str) -> None:
    console.print(line, soft_wrap=True, highlight=False, markup=False)
