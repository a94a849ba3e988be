"""Robots as their driver holds them, in its own process or in one of theirs."""

import traceback
from collections.abc import Iterator
from contextlib import contextmanager

from testbed.link.exchange import Desk, failed, read_decision
from testbed.link.process import spawned_robot
from testbed.protocol import (
    Decision,
    Percept,
    Question,
    RobotClient,
    RobotFactory,
    Task,
    encode,
    in_one_line,
)


class InProcessRobot:
    """A RobotClient that calls the robot directly.

    Questions and answers still pass as bytes, so that a robot cannot tell where it runs. What a
    single process cannot do is outlive its robot: there is no answer limit here.
    """

    def __init__(self, make_robot: RobotFactory) -> None:
        self._desk = Desk(make_robot)
        self._task: Task | None = None

    def begin(self, task: Task) -> None:
        """Prepare a trial; the robot is made at its first percept."""
        self._task = task

    def ask(self, percept: Percept) -> Decision:
        """Return the robot's decision. Raises RobotLost."""
        question = encode(Question(percept=percept, task=self._task))
        self._task = None
        return read_decision(self._answer(question), percept)

    def close(self) -> None:
        """Nothing to let go of."""

    def _answer(self, question: bytes) -> bytes:
        try:
            return self._desk.answer(question)
        except Exception as error:
            raise failed(in_one_line(error), traceback.format_exc()) from error


@contextmanager
def connect(
    link: str, make_robot: RobotFactory, run: str, answer_s: float, group: int = 0
) -> Iterator[RobotClient]:
    """Yield a robot that plays trial after trial; ends its process, if it has one.

    It is in this process (``link`` is ``"inprocess"``), made by ``make_robot``, or in a process of
    its own, in the process group ``group``, with ``answer_s`` seconds for an answer
    (``"zenoh"``). Raises RobotLost when that does not start.
    """
    if link == "inprocess":
        yield InProcessRobot(make_robot)
        return
    with spawned_robot(run, answer_s, group=group) as robot:
        robot.start()
        yield robot
