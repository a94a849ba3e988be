"""A session of the command line over a run folder: run or go on, then tables and report."""

import shlex
import sys
from collections.abc import Iterator, Sequence
from contextlib import suppress
from pathlib import Path
from textwrap import wrap

from testbed.config import ExperimentConfig
from testbed.experiment.interrupts import INTERRUPTED, stoppable
from testbed.experiment.lock import locked
from testbed.experiment.plan import trials_of
from testbed.experiment.progress import progress
from testbed.experiment.run_folder import CONFIG, REPORT, choose_folder, holds_run
from testbed.experiment.runner import run_in
from testbed.experiment.shard import Shard
from testbed.experiment.specs import TrialSpec
from testbed.experiment.status import RunStatus
from testbed.protocol import shortened
from testbed.report import Report, Tables, grid, write_report, written_report
from testbed.text import Printer, Say, columns, counted

MOST_OF_REASON = 200
"""Characters of a reason that are said on the terminal; the report has all of it."""


def run_session(
    config: ExperimentConfig,
    out: Path | None,
    workers: int | None,
    resume: bool,
    quiet: bool,
    retry_failed: bool = False,
    shard: Shard | None = None,
) -> int:
    """Run a configuration and report; the exit code.

    Raises:
        StoreError: before anything is run.
        WorkerError: where no trial can be played; what is on record stays.
    """
    folder = choose_folder(out, config.name, resume)
    say = Printer(quiet)
    if resume and not holds_run(folder):
        say(f"nothing to resume: a new run in {folder}")
    with locked(folder), stoppable(_to_go_on(folder, shard), quiet):
        with progress(quiet) as notify:
            command = ["testbed", *sys.argv[1:]]
            run = run_in(folder, config, workers, notify, resume, retry_failed, command, shard)
        try:
            _conclude(folder, config, run, say, shard)
        except KeyboardInterrupt:  # the trials are on record, the report is not made
            say(f"interrupted; for the report: testbed report {shlex.quote(str(folder))}")
            return INTERRUPTED
    return run.exit_code


def report_again(folder: Path, config: ExperimentConfig) -> Report:
    """Table, summary and report of a run, made again. Raises StoreError."""
    say = Printer()
    report = written_report(folder, config, _plan(config))
    for line in _told(report.tables):
        say(line)
    say(f"report: {folder / REPORT}")
    return report


def _plan(config: ExperimentConfig) -> Iterator[TrialSpec] | None:
    """The trials that records are to be of; to draw levels again takes long."""
    return None if config.is_fine else trials_of(config)


def serve_reports(reports: Sequence[Report], port: int) -> None:
    """Serve reports to browsers of this machine until interrupted. Raises OSError.

    Several have a page together, and each its own below that.
    """
    from testbed.report.page import page_of_several
    from testbed.report.serving import Server, Site  # few serve

    say = Printer()
    whole, *parts = [Site(own.page(served=True), [own.run]) for own in reports]
    if parts:
        parts = [whole, *parts]
        whole = Site(page_of_several(reports), [own.run for own in reports])
    with Server(whole, parts, port) as server, suppress(KeyboardInterrupt):
        say(f"serving {server.address} (Ctrl-C ends it)")
        server.serve_forever()


def _conclude(
    folder: Path, config: ExperimentConfig, run: RunStatus, say: Say, shard: Shard | None
) -> None:
    tables = write_report(folder, config, _plan(config))
    if tables.rows:
        for line in _told(tables):
            say(line)
    if run.interrupted:
        say(f"interrupted: {run.done} of {counted(run.planned, 'trial')} kept in {folder}")
        say(_to_go_on(folder, shard))
        if not tables.rows:
            return
    if run.failed:
        failed = counted(run.failed, "trial")
        first = "; the first" if run.failed > 1 else ""
        reason = shortened(run.reason or "no reason is known", MOST_OF_REASON)
        say(f"{failed} ended in error or without a robot{first}: {reason} (see the report)")
    say(f"report: {folder / REPORT}")


def _told(tables: Tables) -> Iterator[str]:
    """The tables of a run; the digest is of the trials that the clock had no part in."""
    for answer in tables.answers:
        yield from wrap(answer, columns(), subsequent_indent="    ")
    if tables.rows:
        yield from [""] * bool(tables.answers)
        yield from grid(tables.rows).lines(columns())
        for own in tables.grids:
            yield from ("", *own.lines(columns()))
        yield from (note for row in tables.rows for note in row.notes())
        if tables.left_out is not None:
            yield tables.left_out
        yield from wrap(f"condition: {tables.condition}", columns(), subsequent_indent="    ")
    if tables.notice is not None:
        yield f"incomplete: {tables.notice}"
    if tables.rows:
        played = sum(row.trials + row.lost for row in tables.rows)
        late = f", without {tables.late} with a deadline" if tables.late else ""
        yield f"digest of {counted(played - tables.late, 'trial')}{late}: {tables.digest}"


def _to_go_on(folder: Path, shard: Shard | None) -> str:
    run = ["testbed", "run", str(folder / CONFIG), "--out", str(folder), "--resume"]
    run += [] if shard is None else ["--shard", str(shard)]
    return f"to go on: {shlex.join(run)}"
