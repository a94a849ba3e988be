"""How a run stands, for those who are told while it goes on."""

from collections.abc import Callable
from dataclasses import dataclass
from typing import NamedTuple

from testbed.experiment.interrupts import INTERRUPTED


class Estimate(NamedTuple):
    """Trials of a condition that are to be played, and the seconds that one process needs.

    `seconds` is None as long as the first pairs are being played.
    """

    cell: str
    trials: int
    seconds: float | None


@dataclass
class RunStatus:
    """A run as it stands: trials planned, on record, and failed; whether it was stopped.

    `reason` is that of the first failed trial, None where none failed; `workers` are the processes
    that play what was missing, None where they are those of a scheduler. `estimates` are those of
    a sweep, one per condition of which trials were missing; `dashboard` is the address of Dask's.
    """

    planned: int
    done: int
    failed: int
    reason: str | None = None
    workers: int | None = 1
    interrupted: bool = False
    estimates: tuple[Estimate, ...] = ()
    dashboard: str | None = None

    @property
    def exit_code(self) -> int:
        """0 for a run that is done, 1 where trials failed, 130 where it was interrupted."""
        return INTERRUPTED if self.interrupted else int(self.failed > 0)


Notify = Callable[[RunStatus], None]
