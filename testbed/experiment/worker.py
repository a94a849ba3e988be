"""A worker: a process that plays trials, one after the other.

Workers are spawned: a forked process with an open zenoh session hangs. Each leads a process group,
to which its robots belong: no signal of the driver's terminal reaches either, and killing the
group leaves nobody behind, whatever they are doing.
"""

import os
import signal
from collections import deque
from collections.abc import Callable, Iterator
from contextlib import AbstractContextManager, ExitStack, contextmanager, suppress
from multiprocessing import get_context, parent_process
from multiprocessing.connection import Connection
from threading import Thread

from testbed.experiment.errors import WorkerError
from testbed.experiment.interrupts import SIGNALS, interrupts_later, kill
from testbed.experiment.recorder import Result
from testbed.experiment.specs import TrialSpec
from testbed.protocol import RobotLost, in_one_line

Play = Callable[[TrialSpec], Result]
OpenPlayer = Callable[[], AbstractContextManager[Play]]

EXIT_S = 10.0
SAFE_PATH = "PYTHONSAFEPATH"


class Worker:
    """A process, the pipe to it, and positions: of the trial that it plays, of its next.

    It is `ready` once it has said that it can play.
    """

    def __init__(self, open_player: OpenPlayer) -> None:
        context = get_context("spawn")
        self.pipe, self._far_end = context.Pipe()
        self._process = context.Process(target=_serve, args=(self._far_end, open_player))
        self.ready = False
        self.position: int | None = None
        self.next: deque[int] = deque()

    def start(self) -> None:
        """Start the process, deaf to the signals that this one gets."""
        with safe_path(), interrupts_later():
            self._process.start()
        self._far_end.close()

    def play(self, position: int, spec: TrialSpec) -> None:
        """Give it a trial; a dead worker shows when its answer is received."""
        self.position = position
        with suppress(OSError):
            self.pipe.send(spec)

    def receive(self) -> Result | None:
        """What it says: None once it is ready, then the results of its trials.

        Raises:
            EOFError: when it ended in the middle of a trial.
            WorkerError: when it could not get ready.
        """
        try:
            said: Result | str | None = self.pipe.recv()
        except (EOFError, OSError):
            if self.ready:
                raise EOFError from None
            code = self.end(at_once=True)
            raise not_ready(f"a process ended with exit code {code} as it started") from None
        if isinstance(said, str):
            raise not_ready(said)
        self.ready = True
        return said

    def leave(self, at_once: bool) -> None:
        """Tell the process that nothing is left to play, or kill it with its robots."""
        self.pipe.close()
        if at_once and self._process.pid is not None:
            kill(self._process)

    def end(self, at_once: bool) -> int | None:
        """End the process and return its exit code; None of one that did not start."""
        self.leave(at_once)
        if self._process.pid is not None:
            self._process.join(EXIT_S)
            if self._process.exitcode is None:
                kill(self._process)
                self._process.join()
        return self._process.exitcode


def not_ready(reason: str) -> WorkerError:
    """The error of a process that cannot play."""
    return WorkerError(f"no trial can be played: {reason}")


def why_not_ready(error: Exception) -> str:
    """Why a process cannot play, in one line."""
    return str(error) if isinstance(error, RobotLost) else in_one_line(error)


def _serve(pipe: Connection, open_player: OpenPlayer) -> None:
    """A worker's life: until the pipe closes, or the driver is gone."""
    os.setsid()
    for number in SIGNALS:
        signal.signal(number, signal.SIG_IGN)
    Thread(target=_end_with_driver, daemon=True).start()
    with suppress(EOFError, OSError), ExitStack() as stack:
        try:
            play = stack.enter_context(open_player())
        except Exception as error:
            pipe.send(why_not_ready(error))
            return
        pipe.send(None)
        while True:
            pipe.send(play(pipe.recv()))


def _end_with_driver() -> None:
    driver = parent_process()
    assert driver is not None
    driver.join()
    os.killpg(0, signal.SIGKILL)


@contextmanager
def safe_path() -> Iterator[None]:
    """Let a Python that is started in this block import nothing from the working directory."""
    before = os.environ.get(SAFE_PATH)
    os.environ[SAFE_PATH] = "1"
    try:
        yield
    finally:
        if before is None:
            del os.environ[SAFE_PATH]
        else:
            os.environ[SAFE_PATH] = before
