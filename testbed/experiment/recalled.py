"""A robot that answers as a record has it: the replay of a robot that a person played."""

from agents.shared.presence import answered
from testbed.experiment.record import TrialRecord
from testbed.protocol import WAIT, Decision, Percept, RobotStops, Task


class Recalled:
    """Attempts what is recorded at each step, and waits at the others."""

    def __init__(self, record: TrialRecord | None) -> None:
        self._record = record

    def begin(self, task: Task) -> None:
        """There is nothing to prepare."""

    def act(self, percept: Percept) -> Decision:
        """The recorded answer. Raises RobotStops where there is no record."""
        if self._record is None:
            raise RobotStops("a game of a person is not on record, so that it cannot be replayed")
        answers = (*self._record.actions, *self._record.mental)
        found = (own.action for own in answers if own.step == percept.step)
        return answered(percept, next(found, WAIT))
