"""A robot whose decisions are those of a person."""

from collections.abc import Callable
from typing import ClassVar

from agents.shared.presence import Presence, answered
from asp.language import Action
from testbed.protocol import Capabilities, Decision, Percept, RobotStops, Task

PERSON: Presence[Callable[[Task, Percept], Action]] = Presence("robot")
"""Who is asked for the robot's action: a physical one, `wait`, or `finish`."""


class Human:
    """Does what a person answers, who is told what a robot is told. It tells nothing of a mind."""

    capabilities: ClassVar = Capabilities(
        knowledge=("complete", "seen"), plans=("optimistic", "conformant"), snapshots=True
    )
    _task: Task

    def begin(self, task: Task) -> None:
        """Takes on the task."""
        self._task = task

    def act(self, percept: Percept) -> Decision:
        """The person's decision. Raises RobotStops where there is no person to ask."""
        if PERSON.ask is None:
            raise RobotStops("nobody is there to ask; play it by: testbed play CONFIG --as robot")
        return answered(percept, PERSON.ask(self._task, percept))

    def snapshot(self) -> Task:
        """The task: what a person remembers is not taken back."""
        return self._task

    def restore(self, snapshot: Task) -> None:
        """Goes back to the task."""
        self._task = snapshot
