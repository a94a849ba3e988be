"""Run a configuration into a run folder: all trials of a new run, the rest of one that was left."""

import sys
from collections.abc import Callable, Iterator, Sequence
from contextlib import closing, contextmanager
from functools import partial
from importlib.util import find_spec
from pathlib import Path

from testbed.config import ConfigError, ExperimentConfig, dotted
from testbed.experiment.checks import CHECKS, person_findings
from testbed.experiment.errors import WorkerError
from testbed.experiment.interrupts import uninterrupted
from testbed.experiment.lock import locked
from testbed.experiment.pilot import Pilot
from testbed.experiment.plan import plan_trials, planned_trials, sweep_findings
from testbed.experiment.provenance import Provenance
from testbed.experiment.record import FAILURES
from testbed.experiment.recorder import Result
from testbed.experiment.robots import make_robot
from testbed.experiment.run_folder import (
    ERRORS,
    begin_or_resume,
    choose_folder,
    naming,
    stored_text,
)
from testbed.experiment.shard import Shard
from testbed.experiment.specs import TrialSpec
from testbed.experiment.status import Notify, RunStatus
from testbed.experiment.store import TrialWriter, read_records
from testbed.experiment.texts import sha256
from testbed.experiment.trial import play_trial
from testbed.experiment.worker import Play
from testbed.experiment.worker_pool import Results, play_all, workers_for
from testbed.link import connect

BAD_INPUT = 2
"""The exit code where no trial can be played."""


def run(
    config: ExperimentConfig,
    folder: Path | None = None,
    workers: int | None = None,
    *,
    resume: bool = False,
    retry_failed: bool = False,
    shard: Shard | None = None,
) -> RunStatus:
    """Play the trials of a configuration into a folder, without one into `runs/NAME`.

    With `resume` a run that the folder holds goes on, with `retry_failed` its failed trials are
    played again. Of a `shard` only its trials are played. `workers` are the processes that play,
    0 for this one; without a number there are as many as the trials are worth.

    Raises:
        ConfigError: for robots or an adversary that there are not, or that cannot do what is asked.
        StoreError: for a folder that holds another run, or that another process writes into.
        WorkerError: when no trial can be played.
    """
    findings = [
        found for check in (*CHECKS, person_findings, sweep_findings) for found in check(config)
    ]
    if findings:
        raise ConfigError([f"{dotted(key)}: {message}" for key, message in findings])
    folder = choose_folder(folder, config.name, resume)
    with locked(folder):
        return run_in(
            folder, config, workers, lambda _: None, resume, retry_failed, sys.argv, shard
        )


def run_in(
    folder: Path,
    config: ExperimentConfig,
    workers: int | None,
    notify: Notify,
    resume: bool,
    retry_failed: bool,
    command: Sequence[str],
    shard: Shard | None = None,
) -> RunStatus:
    """As `run`, in a folder that is locked; `command` is put on record."""
    if workers and config.scheduler is not None:
        raise WorkerError("--workers: does not go with scheduler, which has workers of its own")
    begin_or_resume(folder, config, resume)
    provenance = Provenance(folder, config, command, shard=shard)
    try:
        played = play_missing(config, folder, workers, notify, retry_failed, shard)
    except WorkerError:
        provenance.close(BAD_INPUT, workers=0)
        raise
    except KeyboardInterrupt:  # while the trials were planned: none was played
        planned, done = sum(planned_trials(config).values()), sum(1 for _ in read_records(folder))
        if shard is not None:
            planned = shard.share(planned, len(config.robots))
        played = RunStatus(planned, done, failed=0, workers=0, interrupted=True)
    provenance.close(played.exit_code, played.workers)
    return played


def play_missing(
    config: ExperimentConfig,
    folder: Path,
    workers: int | None,
    notify: Notify,
    retry: bool = False,
    shard: Shard | None = None,
) -> RunStatus:
    """Play every trial of `config` that `folder` has no record of; append them in their order.

    With `retry` those that failed are played, too, and their records replaced. Of a `shard` only
    its trials are played.
    Without a number of `workers` there are as many as the missing trials are worth; 0 plays them
    in this process. An interrupt ends the run early: what was finished is on record, and the run
    says so. `notify` is called once at the start, when Dask's dashboard is known, and after every
    trial.

    Raises:
        StoreError: when the folder cannot be written to, or has records of other trials.
        WorkerError: when no trial can be played.
    """
    specs = plan_trials(config)
    with TrialWriter(folder, specs) as writer:
        failed = {} if retry else {t: why[-1] for t, why in writer.failures.items()}
        done = writer.done.difference(writer.failures) | failed.keys()
        own = specs if shard is None else shard.of(specs)
        missing = [spec for spec in own if spec.trial not in done]
        status = RunStatus(len(own), len(own) - len(missing), len(failed))
        status.reason = next(iter(failed.values()), None)
        status.workers = _workers(config, len(missing)) if workers is None else workers
        record = partial(_record, folder, writer, status, sha256(stored_text(config)))

        def play(specs: Sequence[TrialSpec]) -> Results:
            return _told(_results(config, specs, status.workers, shown_at), writer)

        def shown_at(dashboard: str) -> None:
            status.dashboard = dashboard
            notify(status)

        if config.is_sweep and missing:
            _sweep(play, missing, record, status, notify)
            return status
        notify(status)
        if missing:
            _put_on_record(play(missing), record, status, notify)
    return status


def _sweep(
    play: Callable[[Sequence[TrialSpec]], Results],
    missing: Sequence[TrialSpec],
    record: Callable[[Result], None],
    status: RunStatus,
    notify: Notify,
) -> None:
    """Play the trials of a sweep, and tell what they will take as soon as it can be estimated."""
    pilot = Pilot(missing)

    def tell(status: RunStatus) -> None:
        status.estimates = pilot.estimates
        notify(status)

    tell(status)
    _put_on_record(pilot.results(play(pilot.order)), record, status, tell)


def _workers(config: ExperimentConfig, missing: int) -> int | None:
    """The processes that are to play; None where they are a scheduler's."""
    return workers_for(missing) if config.scheduler is None else None


def _results(
    config: ExperimentConfig,
    specs: Sequence[TrialSpec],
    workers: int | None,
    shown_at: Callable[[str], None],
) -> Results:
    """The results of trials by the configuration's runner; 0 workers are this process."""
    open_player = partial(player, config.link, config.name, config.limits.answer_s)
    if workers is not None and (config.runner == "local" or workers == 0):
        return play_all(specs, workers, open_player)
    if find_spec("distributed") is None:
        raise WorkerError("runner: dask is not installed; pip install 'intention-testbed[cluster]'")
    from testbed.experiment import dask_client, dask_pool  # noqa: PLC0415  # of an extra

    if config.scheduler is None:
        return dask_pool.play_all(specs, workers or 1, open_player, shown_at)
    scheduler = dask_client.Scheduler(config.scheduler, **config.tls.files)
    return dask_pool.play_all(specs, scheduler, open_player, shown_at)


def _told(results: Results, writer: TrialWriter) -> Results:
    """The results; their stories are kept as they come, so that none waits for its turn."""
    with closing(results):
        for position, result in results:
            if result.story is not None:
                writer.tell(result.story)
                result.story = None
            yield position, result


def _put_on_record(
    results: Results, record: Callable[[Result], None], status: RunStatus, notify: Notify
) -> None:
    """Put results on record in the order of the plan, whatever the order in which they come."""
    early: dict[int, Result] = {}
    turn = 0
    try:
        for position, result in results:
            with uninterrupted():  # a trial on record is counted
                early[position] = result
                while turn in early:
                    record(early.pop(turn))
                    turn += 1
                status.done += 1
                status.failed += result.record.outcome in FAILURES
            notify(status)
    except KeyboardInterrupt:
        status.interrupted = True
    finally:
        results.close()
        for position in sorted(early):  # on an interrupt their turn does not come any more
            record(early[position])


def _record(
    folder: Path, writer: TrialWriter, status: RunStatus, config_sha256: str, result: Result
) -> None:
    if result.record.origin is not None:
        result.record.origin.config_sha256 = config_sha256
    if result.record.outcome in FAILURES:
        status.reason = status.reason or result.record.reason
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
    with connect(link, make_robot, run, answer_s) as robot:
        yield lambda spec: play_trial(spec, robot)
