"""A robot that a file `hold` stops after a number of trials, and the command line beside it.

With a file `broken` the robot fails. A file `stuck` holds the command where trials are planned,
deaf to interrupts as only foreign code can be.
"""

import time
from contextlib import suppress
from pathlib import Path
from typing import ClassVar

from agents.intentional import IntentionalRobot
from agents.intentional.controller import Reference
from testbed import cli
from testbed.config import ExperimentConfig
from testbed.experiment import plan, runner
from testbed.experiment.specs import TrialSpec
from testbed.protocol import Task

BROKEN = Path("broken")
"""With what it says the robot fails."""
HOLD = Path("hold")
"""Says how many trials the robot of each process may begin; all, where it is not there."""


class Held(IntentionalRobot):
    """An intentional robot that waits where it may not begin another trial."""

    capabilities: ClassVar = Reference.capabilities
    begun = 0

    def begin(self, task: Task) -> None:
        if BROKEN.exists():
            raise RuntimeError(BROKEN.read_text() or "broken")
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

if __name__ == "__main__":
    cli.main()
