"""The command line with one robot more: `held` begins no trial while a file `hold` is there.

Worker processes import this module as their main one, and so know the robot, too.
"""

from __future__ import annotations

import time
from pathlib import Path

from agents.intentional import IntentionalRobot
from testbed import cli
from testbed.experiment import registry
from testbed.link.messages import Task

HOLD = Path("hold")


class Held(IntentionalRobot):
    """An intentional robot that waits until it may begin."""

    def begin(self, task: Task) -> None:
        while HOLD.exists():
            time.sleep(0.01)
        super().begin(task)


registry.ROBOTS = {**registry.ROBOTS, "held": Held}

if __name__ == "__main__":
    cli.main()
