"""One question and its answer, whatever carries them.

The robot's side (:class:`Desk`) turns the bytes of a question into the bytes of a decision; the
driver's side (:class:`Client`) accepts nothing but the decision it asked for. In process and over
zenoh both are the same.
"""

import traceback
from abc import abstractmethod

from testbed.protocol import (
    FINISH,
    MOST_BYTES,
    NOT_UNDERSTOOD,
    Decision,
    LinkError,
    Percept,
    Question,
    Robot,
    RobotClient,
    RobotFactory,
    RobotLost,
    RobotStopped,
    RobotStops,
    Task,
    Trace,
    decode,
    encode,
    in_one_line,
    shortened,
)


class Desk:
    """The robot's side: a new robot for every trial, and one trial at a time."""

    def __init__(self, make_robot: RobotFactory) -> None:
        self._make_robot = make_robot
        self._robots: dict[str, Robot] = {}

    def answer(self, payload: bytes) -> bytes:
        """Return the bytes of the decision on a question.

        Raises LinkError for a question not understood or of a trial that has not begun, and
        whatever the robot raises.
        """
        question = decode(payload, Question)
        task, percept = question.task, question.percept
        if task is not None:
            self._robots.clear()
            robot = self._make_robot(task.robot)
            robot.begin(task)
            self._robots[task.trial] = robot
        if percept.trial not in self._robots:
            raise LinkError(f"trial {percept.trial} has not begun here")
        try:
            return encode(self._robots[percept.trial].act(percept))
        except RobotStops as reason:
            stopped = Decision(
                trial=percept.trial,
                step=percept.step,
                action=FINISH,
                believes_goal=False,
                trace=Trace(),
                stopped=shortened(str(reason)),
            )
            return encode(stopped)


class Client(RobotClient):
    """The driver's side: the task of a trial goes out with its first percept."""

    _task: Task | None = None

    def begin(self, task: Task) -> None:
        """Prepare a trial."""
        self._task = task

    def ask(self, percept: Percept) -> Decision:
        """Return the robot's decision.

        Raises RobotLost when there is no answer, or one that is not understood, too long, or for
        another trial or step, and RobotStopped when the robot does not go on.
        """
        question = encode(Question(percept=percept, task=self._task))
        self._task = None
        return understood(self._answer(percept.trial, question), percept)

    @abstractmethod
    def _answer(self, trial: str, question: bytes) -> bytes:
        """The bytes of the answer to those of a question. Raises RobotLost."""


class InProcessRobot(Client):
    """A client that calls the robot directly, which it makes at the first percept of a trial.

    Questions and answers still pass as bytes, so that a robot cannot tell where it runs. What a
    single process cannot do is outlive its robot: there is no answer limit here.
    """

    def __init__(self, make_robot: RobotFactory) -> None:
        self._desk = Desk(make_robot)

    def close(self) -> None:
        """Nothing to let go of."""

    def _answer(self, _trial: str, question: bytes) -> bytes:
        try:
            return self._desk.answer(question)
        except Exception as error:
            raise failed(in_one_line(error), traceback.format_exc()) from error


def understood(payload: bytes, percept: Percept) -> Decision:
    """The decision on a percept that these bytes are.

    Raises RobotLost for what is not understood, too long, or for another trial or step, and
    RobotStopped when the robot does not go on.
    """
    if len(payload) > MOST_BYTES:
        raise RobotLost(f"{NOT_UNDERSTOOD}: {len(payload)} bytes; {MOST_BYTES} are the most")
    try:
        decision = decode(payload, Decision)
    except LinkError as error:
        raise RobotLost(f"{NOT_UNDERSTOOD}: {error}") from error
    given, asked = (f"step {own.step} of trial {own.trial}" for own in (decision, percept))
    if given != asked:
        raise RobotLost(f"answer is for {given}, the question was for {asked}")
    if decision.stopped is not None:
        raise RobotStopped(decision.stopped)
    return decision


def failed(text: str, details: str = "") -> RobotLost:
    """Return the loss of a robot that raised an exception with this text."""
    return RobotLost(shortened(f"robot failed: {' '.join(text.split())}"), details)
