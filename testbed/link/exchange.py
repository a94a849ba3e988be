"""One question and its answer, whatever carries them.

The robot's side (:class:`Desk`) turns the bytes of a question into the bytes of a decision; the
driver's side (:func:`read_decision`) accepts nothing but the decision it asked for. In process
and over zenoh both are the same.
"""

from asp.language import Literal
from testbed.protocol import (
    MOST_BYTES,
    Decision,
    LinkError,
    Percept,
    Question,
    Robot,
    RobotFactory,
    RobotLost,
    RobotStopped,
    RobotStops,
    Task,
    Trace,
    decode,
    encode,
    shortened,
)
from testbed.protocol.errors import NOT_UNDERSTOOD


class Desk:
    """The robot's side: a new robot for every trial, and one trial at a time."""

    def __init__(self, make_robot: RobotFactory) -> None:
        self._make_robot = make_robot
        self._trial: str | None = None
        self._robot: Robot | None = None

    def answer(self, payload: bytes) -> bytes:
        """Return the bytes of the decision on a question.

        Raises LinkError for a question not understood or of a trial that has not begun, and
        whatever the robot raises.
        """
        question = decode(payload, Question)
        if question.task is not None:
            self._begin(question.task)
        percept = question.percept
        robot = self._robot_of(percept)
        try:
            return encode(robot.act(percept))
        except RobotStops as reason:
            return encode(_stopped(percept, shortened(str(reason))))

    def _begin(self, task: Task) -> None:
        self._trial, self._robot = task.trial, None
        robot = self._make_robot(task.robot)
        robot.begin(task)
        self._robot = robot

    def _robot_of(self, percept: Percept) -> Robot:
        if self._robot is None or percept.trial != self._trial:
            raise LinkError(f"trial {percept.trial} has not begun here")
        return self._robot


def read_decision(payload: bytes, percept: Percept) -> Decision:
    """Return the decision in an answer to ``percept``.

    Raises RobotLost when it is not understood, too long, or belongs to another trial or step, and
    RobotStopped when the robot does not go on.
    """
    if len(payload) > MOST_BYTES:
        raise RobotLost(f"{NOT_UNDERSTOOD}: {len(payload)} bytes; {MOST_BYTES} are the most")
    try:
        decision = decode(payload, Decision)
    except LinkError as error:
        raise RobotLost(f"{NOT_UNDERSTOOD}: {error}") from error
    given, asked = (decision.trial, decision.step), (percept.trial, percept.step)
    if given != asked:
        raise RobotLost(f"answer is for {_place(*given)}, the question was for {_place(*asked)}")
    if decision.stopped is not None:
        raise RobotStopped(decision.stopped)
    return decision


def failed(text: str, details: str = "") -> RobotLost:
    """Return the loss of a robot that raised an exception with this text."""
    return RobotLost(shortened(f"robot failed: {' '.join(text.split())}"), details)


def _stopped(percept: Percept, reason: str) -> Decision:
    return Decision(
        trial=percept.trial,
        step=percept.step,
        action=Literal.parse("finish"),
        believes_goal=False,
        trace=Trace(),
        stopped=reason,
    )


def _place(trial: str, step: int) -> str:
    return f"step {step} of trial {trial}"
