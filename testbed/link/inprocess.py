"""A robot in the driver's own process: no zenoh, the same messages."""

import traceback

from testbed.link.exchange import Desk, failed, in_one_line, read_decision
from testbed.protocol.messages import Decision, Percept, Question, Task, encode
from testbed.protocol.robot import RobotFactory


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
