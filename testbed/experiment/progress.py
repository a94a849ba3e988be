"""How a run goes on, told on standard error: its plan, trials done, their rate, the time left."""

import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager

from rich.console import Console
from rich.progress import BarColumn, MofNCompleteColumn, Progress, TextColumn, TimeRemainingColumn

from testbed.experiment.status import Estimate, Notify, RunStatus
from testbed.text import Say, columns, counted, warn
from testbed.text.grid import Grid

EVERY_S = 30.0
MOST_LINES = 40
"""Conditions of a sweep that are listed in its plan."""


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

            def say(line: str) -> None:
                bar.console.print(line, markup=False, highlight=False)

            plan, dashboard = Plan(say), Dashboard(say)

            def notify(run: RunStatus) -> None:
                plan.notify(run)
                dashboard.notify(run)
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
        self._plan, self._dashboard = Plan(say), Dashboard(say)
        self._began: tuple[float, int] | None = None
        self._due = 0.0

    def notify(self, run: RunStatus) -> None:
        """Told at the start and after every trial."""
        self._plan.notify(run)
        self._dashboard.notify(run)
        now = self._clock()
        if self._began is None:
            self._began, self._due = (now, run.done), now + EVERY_S
        elif now >= self._due:
            self._due = now + EVERY_S
            began, done = self._began
            self._say(in_line(run, (run.done - done) / (now - began)))


def in_line(run: RunStatus, rate: float | None) -> str:
    """Trials that are done and that failed; with a rate per second, that and the time left."""
    trials = f"{run.done} of {counted(run.planned, 'trial')}{_failed(run)}"
    if not rate:
        return trials
    return f"{trials}, {rate:.1f}/s, {_clock((run.planned - run.done) / rate)} left"


class Plan:
    """Says what a sweep plays, and once its first pairs are played what that is to take."""

    def __init__(self, say: Say) -> None:
        self._say = say
        self._told: tuple[Estimate, ...] = ()

    def notify(self, run: RunStatus) -> None:
        """Told at the start and after every trial."""
        if run.estimates == self._told:
            return
        known = run.estimates[0].seconds is not None
        if not self._told and not known:
            trials = sum(own.trials for own in run.estimates)
            of = f"{counted(len(run.estimates), 'condition')}, {counted(trials, 'trial')} to play"
            self._say(f"{of}; the first of each condition and scenario give the estimated time")
        if known:
            for line in plan_of(run).lines(columns()):
                self._say(line)
        self._told = run.estimates


class Dashboard:
    """Says once where the cluster that plays shows what it does."""

    def __init__(self, say: Say) -> None:
        self._say = say
        self._told: str | None = None

    def notify(self, run: RunStatus) -> None:
        """Told at the start, when it is known, and after every trial."""
        if run.dashboard != self._told:
            self._told = run.dashboard
            self._say(f"dashboard: {run.dashboard}")


def plan_of(run: RunStatus) -> Grid:
    """The conditions of a sweep, their trials, and the time that is estimated for them."""
    workers, estimates = run.workers or 1, run.estimates
    rows = [
        (own.cell, str(own.trials), _clock((own.seconds or 0.0) / workers))
        for own in estimates[:MOST_LINES]
    ]
    if len(estimates) > MOST_LINES:
        rows.append((f"and {len(estimates) - MOST_LINES} more conditions", "", ""))
    seconds = sum(own.seconds or 0.0 for own in estimates) / workers
    rows.append(("all", str(sum(own.trials for own in estimates)), _clock(seconds)))
    by = "one process" if workers == 1 else f"{workers} processes"
    return Grid(("condition", "trials", f"estimated time of {by}"), rows, range(1, 3))


def _clock(seconds: float) -> str:
    whole = round(seconds)
    return f"{whole // 3600}:{whole // 60 % 60:02}:{whole % 60:02}"
