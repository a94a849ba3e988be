"""Play the trials that a run folder lacks: all of a new run, the rest of one that was left."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from functools import partial
from pathlib import Path

from testbed.config import ExperimentConfig
from testbed.experiment.interrupts import INTERRUPTED
from testbed.experiment.plan import plan_trials
from testbed.experiment.record import FAILURES
from testbed.experiment.recorder import Result
from testbed.experiment.robots import make_robot
from testbed.experiment.run_folder import ERRORS, naming
from testbed.experiment.specs import TrialSpec
from testbed.experiment.store import TrialWriter
from testbed.experiment.trial import play_trial
from testbed.experiment.worker import Play
from testbed.experiment.worker_pool import play_all, workers_for
from testbed.link import connect


@dataclass
class RunStatus:
    """A run as it stands: trials planned, on record, and failed; whether it was stopped.

    `reason` is that of the first failed trial, None where none failed; `workers` are the processes
    that play what was missing.
    """

    planned: int
    done: int
    failed: int
    reason: str | None = None
    workers: int = 1
    interrupted: bool = False

    @property
    def exit_code(self) -> int:
        """0 for a run that is done, 1 where trials failed, 130 where it was interrupted."""
        return INTERRUPTED if self.interrupted else int(self.failed > 0)


Notify = Callable[[RunStatus], None]


def play_missing(
    config: ExperimentConfig,
    folder: Path,
    workers: int | None,
    notify: Notify,
    retry_failed: bool = False,
) -> RunStatus:
    """Play every trial of `config` that `folder` has no record of; append them in their order.

    With `retry_failed` those that failed are played, too, and their records replaced.
    Without a number of `workers` there are as many as the missing trials are worth; 0 plays them
    in this process. An interrupt ends the run early: what was finished is on record, and the run
    says so. `notify` is called once at the start and after every trial.

    Raises:
        StoreError: when the folder cannot be written to, or has records of other trials.
        WorkerError: when no trial can be played.
    """
    specs = plan_trials(config)
    with TrialWriter(folder, specs) as writer:
        failed = {} if retry_failed else {t: own[-1] for t, own in writer.failures.items()}
        done = writer.done.difference(writer.failures) | failed.keys()
        missing = [spec for spec in specs if spec.trial not in done]
        run = RunStatus(len(specs), len(specs) - len(missing), len(failed))
        run.reason = next(iter(failed.values()), None)
        run.workers = workers_for(len(missing)) if workers is None else workers
        notify(run)
        if missing:
            _play(missing, config, run, partial(_record, folder, writer, run), notify)
    return run


def _play(
    missing: Sequence[TrialSpec],
    config: ExperimentConfig,
    run: RunStatus,
    record: Callable[[Result], None],
    notify: Notify,
) -> None:
    """Put results on record in the order of the plan, whatever the order in which they come."""
    open_player = partial(player, config.link, config.name, config.limits.answer_s)
    results = play_all(missing, run.workers, open_player)
    early: dict[int, Result] = {}
    turn = 0
    try:
        for position, result in results:
            early[position] = result
            while turn in early:
                record(early.pop(turn))
                turn += 1
            run.done += 1
            run.failed += result.record.outcome in FAILURES
            notify(run)
    except KeyboardInterrupt:
        run.interrupted = True
    finally:
        results.close()
        for position in sorted(early):  # on an interrupt their turn does not come any more
            record(early[position])


def _record(folder: Path, writer: TrialWriter, run: RunStatus, result: Result) -> None:
    if result.record.outcome in FAILURES:
        run.reason = run.reason or result.record.reason
    writer.append(result.record)
    details = folder / ERRORS / f"{result.record.trial}.txt"
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
        yield lambda spec: play_trial(spec, robot)
