"""A robot that answers as a record has it: the replay of a robot that a person played."""

from testbed.experiment.record import TrialRecord
from testbed.protocol import FINISH, WAIT, Decision, Percept, RobotStops, Task, Trace


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
        action = next(found, WAIT)
        return Decision(
            trial=percept.trial,
            step=percept.step,
            action=action,
            believes_goal=action == FINISH,
            trace=Trace(),
        )
