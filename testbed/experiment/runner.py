"""Run the trials of a configuration into a run folder, and go on where a run was left."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from functools import partial
from pathlib import Path

from testbed.config import ExperimentConfig
from testbed.experiment.conformity import check_planned
from testbed.experiment.plan import plan_trials
from testbed.experiment.record import FAILURES
from testbed.experiment.robots import make_robot
from testbed.experiment.specs import TrialSpec
from testbed.experiment.store import ERRORS, TrialWriter, locked, naming
from testbed.experiment.trial import Result, play_trial
from testbed.experiment.worker import Play
from testbed.experiment.worker_pool import play_all, workers_for
from testbed.link import connect
from testbed.protocol import RobotClient


@dataclass
class Tally:
    """How a run stands: trials planned, finished, and of these failed; whether it was stopped.

    `workers` are the processes that play what was missing.
    """

    planned: int
    done: int
    failed: int
    workers: int = 1
    interrupted: bool = False


Notify = Callable[[Tally], None]


def run_trials(
    config: ExperimentConfig, folder: Path, workers: int | None, notify: Notify
) -> Tally:
    """As `go_on`, in a folder that is locked meanwhile."""
    with locked(folder):
        return go_on(config, folder, workers, notify)


def go_on(
    config: ExperimentConfig,
    folder: Path,
    workers: int | None,
    notify: Notify,
    retry_failed: bool = False,
) -> Tally:
    """Play every trial of `config` that `folder` has no record of; append them in their order.

    With `retry_failed` those that failed are played, too, and their records replaced.
    Without a number of `workers` there are as many as the missing trials are worth; 0 plays them
    in this process. An interrupt ends the run early: what was finished is on record, and the tally
    says so. `notify` is called once at the start and after every trial.

    Raises:
        StoreError: when the folder cannot be written to, or has records of other trials.
        WorkerError: when no trial can be played.
    """
    specs = plan_trials(config)
    with TrialWriter(folder) as writer:
        check_planned(folder, specs)
        failed = set(writer.failures)
        done = writer.done - failed if retry_failed else writer.done
        missing = [spec for spec in specs if spec.trial not in done]
        tally = Tally(len(specs), done=len(specs) - len(missing), failed=len(failed & done))
        tally.workers = workers_for(len(missing)) if workers is None else workers
        notify(tally)
        if missing:
            _play_missing(missing, config, _Filing(folder, writer, tally, notify))
    return tally


def _play_missing(missing: Sequence[TrialSpec], config: ExperimentConfig, filing: _Filing) -> None:
    open_player = partial(player, config.link, config.name, config.limits.answer_s)
    results = play_all(missing, filing.tally.workers, open_player)
    try:
        for position, result in results:
            filing.take(position, result)
    except KeyboardInterrupt:
        filing.tally.interrupted = True
    finally:
        results.close()
        filing.flush()


class _Filing:
    """Puts results on record in the order of the plan, whatever the order in which they come."""

    def __init__(self, folder: Path, writer: TrialWriter, tally: Tally, notify: Notify) -> None:
        self.tally = tally
        self._folder, self._writer, self._notify = folder, writer, notify
        self._early: dict[int, Result] = {}
        self._next = 0

    def take(self, position: int, result: Result) -> None:
        self._early[position] = result
        while self._next in self._early:
            self._file(self._early.pop(self._next))
            self._next += 1
        self.tally.done += 1
        self.tally.failed += result.record.outcome in FAILURES
        self._notify(self.tally)

    def flush(self) -> None:
        """File what came before its turn: on an interrupt its turn does not come any more."""
        for position in sorted(self._early):
            self._file(self._early.pop(position))

    def _file(self, result: Result) -> None:
        self._writer.append(result.record)
        details = self._folder / ERRORS / f"{result.record.trial}.txt"
        if result.details:
            details.parent.mkdir(exist_ok=True)
            with naming(details):
                details.write_text(result.details, "utf-8", "backslashreplace")
        else:  # those of an earlier attempt
            details.unlink(missing_ok=True)


@contextmanager
def player(link: str, run: str, answer_s: float) -> Iterator[Play]:
    """What plays trials one after the other, with a robot that lives across them.

    Raises:
        RobotLost: when a robot of another process does not start.
    """
    with connect(link, make_robot, run, answer_s, group=os.getpgrp()) as robot:
        yield partial(_play_with, robot)


def _play_with(client: RobotClient, spec: TrialSpec) -> Result:
    return play_trial(spec, client)
