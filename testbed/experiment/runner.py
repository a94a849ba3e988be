"""Run a configuration into a run folder: its configuration, provenance and trials."""

from __future__ import annotations

import sys
from collections.abc import Sequence
from pathlib import Path

from testbed.config import ExperimentConfig
from testbed.experiment.errors import WorkerError
from testbed.experiment.plan import coverage_of, places_of
from testbed.experiment.provenance import Provenance
from testbed.experiment.resume import Notify, RunStatus, play_missing
from testbed.experiment.run_folder import (
    check_unchanged,
    choose_folder,
    holds_run,
    locked,
    refuse_second_run,
    write_config,
)

BAD_INPUT = 2
"""The exit code where no trial can be played."""


def run(
    config: ExperimentConfig,
    folder: Path | None = None,
    workers: int | None = None,
    *,
    resume: bool = False,
    retry_failed: bool = False,
) -> RunStatus:
    """Play the trials of a configuration into a folder, without one into `runs/NAME`.

    With `resume` a run that the folder holds goes on, with `retry_failed` its failed trials are
    played again. `workers` are the processes that play, 0 for this one; without a number there
    are as many as the trials are worth.

    Raises:
        StoreError: for a folder that holds another run, or that another process writes into.
        WorkerError: when no trial can be played.
    """
    folder = choose_folder(folder, config.name, resume)
    with locked(folder):
        return run_in(folder, config, workers, lambda _: None, resume, retry_failed, sys.argv)


def run_in(
    folder: Path,
    config: ExperimentConfig,
    workers: int | None,
    notify: Notify,
    resume: bool,
    retry_failed: bool,
    command: Sequence[str],
) -> RunStatus:
    """As `run`, in a folder that is locked; `command` is put on record."""
    refuse_second_run(folder, resume)  # another may have begun, and ended, since it was chosen
    if holds_run(folder):
        check_unchanged(folder, config)
    else:
        write_config(folder, config)
    provenance = Provenance(folder, config, command)
    try:
        played = play_missing(config, folder, workers, notify, retry_failed)
    except WorkerError:
        provenance.close(BAD_INPUT, workers=0)
        raise
    except KeyboardInterrupt:  # while the trials were planned: none was played
        covered = coverage_of(places_of(folder), config)
        planned = sum(covered.planned.values())
        done = planned - sum(covered.missing.values())
        played = RunStatus(planned, done, failed=0, workers=0, interrupted=True)
    provenance.close(played.exit_code, played.workers)
    return played
