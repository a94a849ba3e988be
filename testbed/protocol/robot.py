"""The two sides of the link: what a robot is, and how a driver holds one."""

from collections.abc import Callable
from typing import Protocol, TypeAlias

from testbed.protocol.messages import Decision, Percept, Task


class Robot(Protocol):
    """An agent that acts for the length of one trial."""

    def begin(self, task: Task) -> None:
        """Take on the task; called once, before the first percept."""

    def act(self, percept: Percept) -> Decision:
        """Decide what to attempt at ``percept.step``; the decision repeats its trial and step."""


RobotFactory: TypeAlias = Callable[[str], Robot]
"""Makes a new robot of a kind (``Task.robot``), or raises an error that names the known ones."""


class RobotClient(Protocol):
    """A driver's end of the link, the same wherever the robot runs."""

    def begin(self, task: Task) -> None:
        """Prepare a trial; the task goes out with its first percept. Raises RobotLost."""

    def ask(self, percept: Percept) -> Decision:
        """Return the robot's decision. Raises RobotLost: then the trial is over, and the
        next may begin."""

    def close(self) -> None:
        """Let go of the robot; nothing is asked afterwards."""
