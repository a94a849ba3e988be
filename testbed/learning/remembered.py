"""A robot's answers by history, so that what it was told before is not reasoned about again."""

from dataclasses import dataclass, field
from typing import TypeAlias

import msgspec

from asp.language import Action
from testbed.protocol import Percept, RobotClient, Task

MOST = 1_000_000
"""Answers that are remembered; then all are forgotten."""
Told: TypeAlias = bytes
"""A percept, or a task, without the id of its trial."""


class UnlikeError(RuntimeError):
    """A robot answers otherwise when it is told the same again: one line."""


@dataclass
class _Moment:
    """What the robot answered after a history, and what came after that."""

    action: Action | None = None
    later: dict[Told, "_Moment"] = field(default_factory=dict)


class Remembered:
    """A robot that is asked only after histories that are new.

    For robots whose answers follow from their task and percepts, as those of the testbed's do; a
    robot that had to go back is told the history again. `asked` counts the questions to it.
    """

    def __init__(self, robot: RobotClient) -> None:
        self.asked = 0
        self._robot = robot
        self._tasks: dict[Told, _Moment] = {}
        self._known = 0

    def begin(self, task: Task) -> None:
        """Begin a game."""
        if self._known >= MOST:
            self._tasks, self._known = {}, 0
        self._task, self._history = task, list[tuple[Percept, _Moment]]()
        self._now = self._tasks.setdefault(_told(task), _Moment())
        self._is_told = 0

    def answer(self, percept: Percept) -> Action:
        """The robot's answer to a percept.

        Raises:
            RobotLost: where the robot fails.
            UnlikeError: where it answers otherwise to what it was told before.
        """
        self._now = self._now.later.setdefault(_told(percept), _Moment())
        self._history.append((percept, self._now))
        if self._now.action is None:
            self._ask()
        assert self._now.action is not None
        return self._now.action

    def _ask(self) -> None:
        """Tell the robot what it does not know of the history, and note its answers."""
        if not self._is_told:
            self._robot.begin(self._task)
        for percept, moment in self._history[self._is_told :]:
            action = self._robot.ask(percept).action
            self.asked += 1
            if moment.action not in (None, action):
                again = f"{action} at step {percept.step}, and {moment.action} before"
                raise UnlikeError(f"told the same again, {self._task.robot} answered {again}")
            self._known += moment.action is None
            moment.action = action
        self._is_told = len(self._history)


def _told(message: Task | Percept) -> Told:
    return msgspec.json.encode(msgspec.structs.replace(message, trial=""), enc_hook=str)
