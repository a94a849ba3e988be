"""Commands about a run of many trials: how long they take, and how much memory."""

import os
import subprocess
import sys
import tempfile
import time
from collections.abc import Iterator, Sequence
from functools import partial
from math import inf
from pathlib import Path

from benchmarks.copies import make_run
from benchmarks.measuring import within
from benchmarks.sheets import Row, Sheet, gathered
from testbed.cli.loading import load
from testbed.config import ExperimentConfig, with_sweep
from testbed.experiment.shard import Shard

STARTS = {"small": 1, "full": 180}
SCENARIOS = {"small": "1,random", "full": "1,2,3,4,5,6,random"}
RATES = {"small": "0.5,1", "full": "0.05:1:0.05"}
SHARDS = 2


def main(size: str) -> list[Sheet]:
    """Sheet `large_runs`: a row per command."""
    config = configuration(STARTS[size], SCENARIOS[size], RATES[size])
    with tempfile.TemporaryDirectory() as folder:
        rows = gathered(_measured(Path(folder), config))
    return [
        Sheet(
            "large_runs",
            "Commands about a run of many trials, each in a process of its own",
            rows,
            (
                "scenarios of the office, and random events, with and without feedback;",
                "one condition is played, records of the others are copies with ids of their own",
            ),
        )
    ]


def configuration(starts: int, scenarios: str, rates: str) -> ExperimentConfig:
    """A sweep from so many starts of each scenario, under two conditions per rate."""
    given = [f"limit={starts}", f"scenarios=[{scenarios}]", "link=inprocess"]
    return load(
        "office", with_sweep([*given, "goal_feedback=true,false", f"adversary.rate={rates}"])
    )


def _measured(folder: Path, config: ExperimentConfig) -> Iterator[Row]:
    whole, parts = folder / "whole", [folder / f"part-{n}" for n in range(1, SHARDS + 1)]
    # In processes of their own: a process that is started counts the memory of its parent.
    trials = within(inf, partial(make_run, whole, config))
    for number, part in enumerate(parts, start=1):
        within(inf, partial(make_run, part, config, Shard(number, SHARDS)))
    commands: dict[str, Sequence[str | Path]] = {
        "report": ["report", whole],
        "report, the table stored": ["report", whole],
        "export": ["export", whole],
        "compare": ["compare", whole],
        "run --resume": ["run", whole / "config.yaml", "--out", whole, "--resume", "--quiet"],
        "merge": ["merge", *parts, "-o", folder / "merged"],
    }
    for name, arguments in commands.items():
        yield {"command": name, "trials": trials, **_of_process(arguments)}


def _of_process(arguments: Sequence[str | Path]) -> Row:
    """What a command takes. Raises RuntimeError where it fails."""
    began = time.perf_counter()
    command = [sys.executable, "-m", "testbed", *map(str, arguments)]
    with subprocess.Popen(command, stdout=subprocess.DEVNULL) as process:
        _, status, usage = os.wait4(process.pid, 0)
        process.returncode = os.waitstatus_to_exitcode(status)
    if process.returncode:
        raise RuntimeError(f"{command} ended with {process.returncode}")
    return {
        "seconds": time.perf_counter() - began,
        "cpu_s": usage.ru_utime + usage.ru_stime,
        "peak_mb": usage.ru_maxrss / 1e3,
    }
