"""A robot as a process of this machine, started and ended by its driver, and a new one after it.

`connect` gives a driver such a robot, or one in its own process.
"""

import os
import signal
import subprocess
import sys
import tempfile
from collections.abc import Iterator, Sequence
from contextlib import ExitStack, closing, contextmanager
from dataclasses import dataclass
from itertools import count

import zenoh

from testbed.link.exchange import InProcessRobot
from testbed.link.remote import RemoteRobot
from testbed.link.session import endpoint, open_driver
from testbed.protocol import (
    Decision,
    Percept,
    RobotClient,
    RobotFactory,
    RobotGone,
    RobotLost,
    RobotStopped,
    Task,
)

COMMAND = (sys.executable, "-P", "-m", "testbed", "robot")
"""Nothing is imported from the working directory (-P)."""
START_S = 60.0
_GLANCE_S = 0.05
_EXIT_S = 5.0


class RobotProcess:
    """The process of one robot, from its start to :meth:`close`; it ends by itself with its driver.

    ``command`` is completed with ``--connect ENDPOINT --name NAME``. The process joins the process
    group ``group``, 0 for one of its own, which an interrupt at the terminal does not reach.
    """

    def __init__(
        self, endpoint: str, name: str, command: Sequence[str] = COMMAND, group: int = 0
    ) -> None:
        # For appending, since the process shares the offset, which reading moves.
        self._errors = tempfile.TemporaryFile("a+b")  # noqa: SIM115 - lives as long as the process
        self._process = subprocess.Popen(
            [*command, "--connect", endpoint, "--name", name],
            stdin=subprocess.DEVNULL,
            stdout=subprocess.DEVNULL,
            stderr=self._errors,
            process_group=group,
        )
        self.pid = self._process.pid

    @property
    def errors(self) -> str:
        """What the process wrote to its standard error so far."""
        self._errors.seek(0)
        return self._errors.read().decode(errors="replace").strip()

    def ending(self, wait_s: float = 0.0) -> str | None:
        """Return in one line how the process ended, or None if it has not within ``wait_s``."""
        try:
            status = self._process.wait(wait_s)
        except subprocess.TimeoutExpired:
            return None
        if status < 0:
            return f"process ended with signal {-status} ({signal.Signals(-status).name})"
        last_words = self.errors.splitlines()[-1:]
        return ": ".join([f"process ended with status {status}", *last_words])

    def close(self) -> None:
        """End the process at once, whatever it is doing: a robot has nothing to save."""
        self._process.kill()
        self._process.wait()
        self._errors.close()


@contextmanager
def spawned_robot(
    run: str, answer_s: float, command: Sequence[str] = COMMAND, group: int = 0
) -> Iterator["SpawnedRobot"]:
    """Open a driver's session of its own and yield a robot on it; ends the robot's process."""
    with (
        open_driver() as session,
        closing(SpawnedRobot(session, run, answer_s, command, group)) as robot,
    ):
        yield robot


@dataclass(eq=False)
class SpawnedRobot:
    """A RobotClient whose robot process serves trial after trial until it is lost.

    Whatever the loss, what is left of the process is ended with it, and the next trial begins
    with a new one. ``answer_s`` is the answer limit in seconds; ``process`` is the present
    process, None before the first trial and after a loss. ``command`` and ``group`` are those of
    a :class:`RobotProcess`.
    """

    session: zenoh.Session
    run: str
    answer_s: float
    command: Sequence[str] = COMMAND
    group: int = 0

    def __post_init__(self) -> None:
        self._names = (f"spawned-{number}" for number in count(1))
        self._belongings = ExitStack()
        self._remote: RemoteRobot | None = None
        self.process: RobotProcess | None = None

    def start(self) -> None:
        """Have a process before there is a trial for it. Raises RobotLost."""
        with self._ending_on_loss():
            self._present()

    def begin(self, task: Task) -> None:
        """Prepare a trial, with a new process if there is none. Raises RobotLost."""
        with self._ending_on_loss():
            self._present().begin(task)

    def ask(self, percept: Percept) -> Decision:
        """Return the robot's decision. Raises RobotLost."""
        with self._ending_on_loss():
            if self._remote is None:
                raise RobotGone("no robot since the last one was lost: begin a trial first")
            return self._remote.ask(percept)

    def close(self) -> None:
        """End the process."""
        self._belongings.close()
        self._remote = self.process = None

    def _present(self) -> RemoteRobot:
        if self._remote is None:
            name = next(self._names)
            process = RobotProcess(endpoint(self.session), name, self.command, self.group)
            self.process = self._belongings.enter_context(closing(process))
            remote = RemoteRobot(self.session, self.run, name, self.answer_s)
            self._belongings.enter_context(closing(remote))
            glances = count(1)
            while not remote.wait(_GLANCE_S):
                if process.ending() is not None:
                    raise RobotGone("robot ended before it was there")
                if next(glances) * _GLANCE_S >= START_S:
                    raise RobotGone(f"robot did not start within {START_S:g} s")
            self._remote = remote
        return self._remote

    @contextmanager
    def _ending_on_loss(self) -> Iterator[None]:
        try:
            yield
        except RobotStopped:
            raise
        except RobotLost as loss:
            reason, details = loss.reason, loss.details
            if self.process is not None:
                how = self.process.ending(_EXIT_S) if isinstance(loss, RobotGone) else None
                reason, details = how or reason, self.process.errors
            self.close()
            raise type(loss)(reason, details) from loss


@contextmanager
def connect(link: str, factory: RobotFactory, run: str, answer_s: float) -> Iterator[RobotClient]:
    """Yield a robot that plays trial after trial; ends its process, if it has one.

    It is in this process (``link`` is ``"inprocess"``), made by ``factory``, or in a process of
    its own, in the process group of this one, with ``answer_s`` seconds for an answer
    (``"zenoh"``). Raises RobotLost when that does not start.
    """
    if link == "inprocess":
        yield InProcessRobot(factory)
        return
    with spawned_robot(run, answer_s, group=os.getpgrp()) as robot:
        robot.start()
        yield robot
