"""The process that drives a run: its memory over many trials, and how busy its workers are."""

import os
import resource
import tempfile
import time
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

import psutil

from benchmarks.memory import resident_mb
from benchmarks.sheets import Row, Sheet, gathered
from testbed.cli.loading import load
from testbed.config import ExperimentConfig
from testbed.experiment.runner import play_missing
from testbed.experiment.status import RunStatus

TRIALS = {"small": 120, "full": 20_000}
SAMPLES = 10
WORKERS = (1, 2)
STATES = 192
ROBOTS = ("intentional", "traditional")
PAIRS = {"small": 2, "full": 100}  # of each scenario of the published comparison
ROUNDS = {"small": 1, "full": 3}


def main(size: str) -> list[Sheet]:
    """Sheets `driver` (memory), `workers` and `runners` (trials per second)."""
    compared = load("table1", [f"limit={PAIRS[size]}"])
    return [
        Sheet(
            "driver",
            "Resident memory of the driving process, 2 workers",
            gathered(_soak(configuration(TRIALS[size]))),
            ("the office, one room to go to, random events; records are written as they come",),
        ),
        Sheet(
            "workers",
            "Trials of Table 1 per second, and processors busy with them",
            gathered(throughput(compared, workers) for workers in WORKERS),
            (f"processors: {os.cpu_count()}; starting the workers is included",),
        ),
        Sheet(
            "runners",
            "Trials per second with 2 local workers, and then the same trials with 2 of Dask",
            gathered(_rounds(PAIRS[size], ROUNDS[size])),
            (
                "start: until the first trial is played, the rest is from then on; cpu: processor",
                "time per trial, of all processes; ratios above 1: Dask is faster, or needs less",
            ),
        ),
    ]


def configuration(trials: int) -> ExperimentConfig:
    """At least so many small trials: both robots go to a room while others act at random."""
    repeats = -(-trials // (STATES * len(ROBOTS)))
    limit = -(-trials // len(ROBOTS))
    overrides = [
        "link=inprocess",
        "scenarios=[random]",
        "goal=[loc(rob1,library)]",
        f"robots=[{','.join(ROBOTS)}]",
        f"repeats={repeats}",
        f"limit={limit}",
    ]
    return load("office", overrides)


def _soak(config: ExperimentConfig) -> Iterator[Row]:
    """A row when the trials are planned, and after each tenth of them."""
    samples: list[tuple[int, float]] = []

    def sample(tally: RunStatus) -> None:
        if tally.done % max(1, tally.planned // SAMPLES) == 0:
            samples.append((tally.done, resident_mb()))

    with tempfile.TemporaryDirectory() as folder:
        play_missing(config, Path(folder), 2, sample)
    before: float | None = None
    for trials, now in samples:
        growth = None if before is None else now - before
        yield {"trials": trials, "resident_mb": now, "growth_mb": growth}
        before = now


@dataclass(frozen=True)
class Pace:
    """Seconds until the first trial is played; trials per second, and processor time, from then."""

    start_s: float
    per_s: float
    cpu_ms: float


def _rounds(pairs: int, rounds: int) -> Iterator[Row]:
    for number in range(1, rounds + 1):
        local, dask = _pace(pairs, "local"), _pace(pairs, "dask")
        yield {
            "round": number,
            "local_start_s": local.start_s,
            "dask_start_s": dask.start_s,
            "local_per_s": local.per_s,
            "dask_per_s": dask.per_s,
            "ratio": dask.per_s / local.per_s,
            "local_cpu_ms": local.cpu_ms,
            "dask_cpu_ms": dask.cpu_ms,
            "cpu_ratio": local.cpu_ms / dask.cpu_ms,
        }


def _pace(pairs: int, runner: str) -> Pace:
    config = load("table1", [f"limit={pairs}", f"runner={runner}"])
    began = time.perf_counter()
    ends: list[float] = []
    used: list[float] = []

    def note(status: RunStatus) -> None:
        if status.done > len(ends):
            ends.append(time.perf_counter())
            if status.done in (1, status.planned):
                used.append(_present_s())

    with tempfile.TemporaryDirectory() as folder:
        play_missing(config, Path(folder), 2, note)
    trials = len(ends) - 1
    cpu_ms = (used[-1] - used[0]) / trials * 1e3
    return Pace(ends[0] - began, trials / (ends[-1] - ends[0]), cpu_ms)


def _present_s() -> float:
    """Seconds of processor time of this process and of those below it that there are."""
    here = psutil.Process()
    times = [own.cpu_times() for own in (here, *here.children(recursive=True))]
    return float(sum(own.user + own.system for own in times))


def throughput(config: ExperimentConfig, workers: int) -> Row:
    """Worker processes count when they have ended, so that what they used is known after a run."""
    began, used = time.perf_counter(), _processor_s()
    with tempfile.TemporaryDirectory() as folder:
        tally = play_missing(config, Path(folder), workers, lambda _: None)
    seconds, cpu_s = time.perf_counter() - began, _processor_s() - used
    return {
        "workers": workers,
        "trials": tally.done,
        "trials_per_s": tally.done / seconds,
        "trials_per_cpu_s": tally.done / cpu_s,
        "processors_busy": cpu_s / seconds,
    }


def _processor_s() -> float:
    """Seconds of processor time of this process and of those that it waited for."""
    usages = (resource.getrusage(who) for who in (resource.RUSAGE_SELF, resource.RUSAGE_CHILDREN))
    return sum(usage.ru_utime + usage.ru_stime for usage in usages)
