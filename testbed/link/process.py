"""A robot as a process of this machine, started and ended by its driver."""

import signal
import subprocess
import sys
import tempfile
from collections.abc import Sequence

COMMAND = (sys.executable, "-P", "-m", "testbed", "robot")
"""Nothing is imported from the working directory (-P)."""


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

    @property
    def pid(self) -> int:
        """The process id."""
        return self._process.pid

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

    def kill(self) -> None:
        """End the process at once, whatever it is doing: a robot has nothing to save."""
        self._process.kill()
        self._process.wait()

    def close(self) -> None:
        """End the process and let go of what it left."""
        self.kill()
        self._errors.close()
