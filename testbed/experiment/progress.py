"""How a run goes on, told on standard error: trials done, their rate, and the time left."""

import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager

from rich.console import Console
from rich.progress import BarColumn, MofNCompleteColumn, Progress, TextColumn, TimeRemainingColumn

from testbed.experiment.runner import Notify, RunStatus
from testbed.text import Say, counted, warn

EVERY_S = 30.0


@contextmanager
def progress(quiet: bool) -> Iterator[Notify]:
    """A bar where standard error is a terminal; elsewhere a line from time to time."""
    console = Console(stderr=True)
    if quiet:
        yield lambda _: None
    elif console.is_terminal:
        told, rate = TextColumn("{task.description}"), TextColumn("{task.fields[rate]}")
        columns = told, BarColumn(), MofNCompleteColumn(), rate, TimeRemainingColumn()
        with Progress(*columns, console=console) as bar:
            task = bar.add_task("planning the trials", total=None, rate="")

            def notify(run: RunStatus) -> None:
                bar.update(task, total=run.planned, completed=run.done)
                speed = bar.tasks[task].speed
                rate = "" if speed is None else f"{speed:.1f}/s"
                bar.update(task, description=f"trials{_failed(run)}", rate=rate)

            yield notify
    else:
        yield Lines(warn).notify


def _failed(run: RunStatus) -> str:
    return f", {run.failed} failed" if run.failed else ""


class Lines:
    """Says a line whenever `EVERY_S` seconds have passed; the rate is that of this session."""

    def __init__(self, say: Say, clock: Callable[[], float] = time.monotonic) -> None:
        self._say, self._clock = say, clock
        self._began: tuple[float, int] | None = None
        self._due = 0.0

    def notify(self, run: RunStatus) -> None:
        """Told at the start and after every trial."""
        now = self._clock()
        if self._began is None:
            self._began, self._due = (now, run.done), now + EVERY_S
        elif now >= self._due:
            self._due = now + EVERY_S
            self._say(self._line(run, now, *self._began))

    def _line(self, run: RunStatus, now: float, began: float, done: int) -> str:
        rate = (run.done - done) / (now - began)
        left = round((run.planned - run.done) / rate)
        trials = f"{run.done} of {counted(run.planned, 'trial')}{_failed(run)}"
        return f"{trials}, {rate:.1f}/s, {left // 3600}:{left // 60 % 60:02}:{left % 60:02} left"
