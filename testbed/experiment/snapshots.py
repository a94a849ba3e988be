"""Snapshots of robots for searches: a robot's own, or those of one that is told all again."""

from collections.abc import Iterator
from contextlib import contextmanager

from testbed.experiment.robots import ROBOTS, RobotClass
from testbed.protocol import Decision, Percept, Restorable, Task, in_one_line

Told = tuple[Task, tuple[tuple[Percept, str], ...]]
"""A task, and percepts with the actions that were decided on."""


class SnapshotError(RuntimeError):
    """A robot has no snapshots, or cannot do without them: one line that names it."""


def restorable_robot(name: str, replays: bool = True) -> Restorable:
    """A new robot with snapshots; one that has none of its own is `Replayed`.

    Raises:
        RegistryError: as `Registry.find` does.
        SnapshotError: for a robot that has none, unless it `replays`.
    """
    found = ROBOTS.find(name)
    if found.capabilities.snapshots:
        robot = found()
        assert isinstance(robot, Restorable)
        return robot
    if replays:
        return Replayed(name, found)
    raise SnapshotError(
        f"'{name}' has no snapshots, which this search needs; a robot that has the methods "
        "snapshot and restore declares Capabilities(snapshots=True)"
    )


@contextmanager
def going_back(name: str) -> Iterator[None]:
    """What a robot raises in `snapshot` or `restore` is a SnapshotError that names the robot."""
    try:
        yield
    except SnapshotError:
        raise
    except Exception as error:
        raise SnapshotError(f"'{name}' cannot go back: {in_one_line(error)}") from error


class Replayed:
    """A robot without snapshots, which goes back by being made anew and told the same again.

    Going back takes as long as all decisions up to the snapshot.
    """

    def __init__(self, name: str, made: RobotClass) -> None:
        self._name, self._made = name, made
        self._told: Told | None = None

    def begin(self, task: Task) -> None:
        """Begins the task with a new robot."""
        self._robot, self._told = self._made(), (task, ())
        self._robot.begin(task)

    def act(self, percept: Percept) -> Decision:
        """The robot's decision."""
        assert self._told is not None, "a robot begins before it acts"
        decision, (task, told) = self._robot.act(percept), self._told
        self._told = task, (*told, (percept, str(decision.action)))
        return decision

    def snapshot(self) -> Told:
        """What the robot was told so far, and what it decided."""
        assert self._told is not None, "a robot begins before it has snapshots"
        return self._told

    def restore(self, snapshot: Told) -> None:
        """Tells a new robot the same. Raises SnapshotError where it decides otherwise."""
        task, told = snapshot
        self.begin(task)
        for percept, action in told:
            again = self.act(percept).action
            if again != action:
                raise SnapshotError(
                    f"'{self._name}' cannot be replayed: told the same again, it answered {again} "
                    f"at step {percept.step}, and {action} before"
                )
