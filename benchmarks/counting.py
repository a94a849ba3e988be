"""Of a worker that is started with `--preload benchmarks.counting`: the trials that it began.

It writes the id of each into a file of its folder before it plays it; also of one that it is killed
in the middle of.
"""

from pathlib import Path
from typing import Any

from distributed import Worker

from testbed.experiment import runner, trial
from testbed.experiment.recorder import Result
from testbed.experiment.specs import TrialSpec

BEGUN = "begun"


def dask_setup(worker: Worker) -> None:
    """Dask calls this as the worker starts."""
    del worker
    play = trial.play_trial

    def counted(spec: TrialSpec, *others: Any) -> Result:
        with Path(BEGUN).open("a", encoding="utf-8") as file:
            file.write(f"{spec.trial}\n")
        return play(spec, *others)

    runner.play_trial = counted  # type: ignore[assignment, attr-defined]
