"""The command line with one robot more, which a file `hold` stops after a number of trials.

With a file `broken` it fails. A file `stuck` holds the command where trials are planned, deaf to
interrupts as only foreign code can be.

Worker processes import this module as their main one, and so know the robot, too.
"""

from __future__ import annotations

import time
from contextlib import suppress
from pathlib import Path

from agents.intentional import IntentionalRobot
from testbed import cli
from testbed.config import ExperimentConfig
from testbed.experiment import plan, runner
from testbed.experiment import robots as registry
from testbed.experiment.specs import TrialSpec
from testbed.protocol import Task

HOLD = Path("hold")
"""Says how many trials the robot of each process may begin; all, where it is not there."""


class Held(IntentionalRobot):
    """An intentional robot that waits where it may not begin another trial."""

    begun = 0

    def begin(self, task: Task) -> None:
        if Path("broken").exists():
            raise RuntimeError("broken")
        while HOLD.exists() and Held.begun >= int(HOLD.read_text()):
            time.sleep(0.01)
        Held.begun += 1
        super().begin(task)


def _plan_trials(config: ExperimentConfig) -> list[TrialSpec]:
    while Path("stuck").exists():
        with suppress(KeyboardInterrupt):
            time.sleep(0.01)
    return plan.plan_trials(config)


runner.plan_trials = _plan_trials
registry.ROBOTS = {**registry.ROBOTS, "held": Held}

if __name__ == "__main__":
    cli.main()
