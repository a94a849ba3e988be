"""Of a worker that is started with `--preload benchmarks.counting`: the trials that it began.

It writes the id of each into a file of its folder before it plays it; also of one that it is killed
in the middle of. Where its folder has the file STOP as it begins one, it gives that file the name
STANDS, and stands still in the middle of the trial as long as it is there.
"""

from contextlib import suppress
from pathlib import Path
from typing import Any

from distributed import Worker

from benchmarks.clusters import until
from testbed.experiment import runner, trial
from testbed.experiment.recorder import Result
from testbed.experiment.specs import TrialSpec

BEGUN, STOP, STANDS = "begun", "stop", "stands"


def dask_setup(worker: Worker) -> None:
    """Dask calls this as the worker starts."""
    del worker
    play = trial.play_trial

    def counted(spec: TrialSpec, *others: Any) -> Result:
        with Path(BEGUN).open("a", encoding="utf-8") as file:
            file.write(f"{spec.trial}\n")
        with suppress(FileNotFoundError):
            Path(STOP).rename(STANDS)
            until(lambda: not Path(STANDS).exists())
        return play(spec, *others)

    runner.play_trial = counted  # type: ignore[assignment, attr-defined]
