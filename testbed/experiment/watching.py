"""Watch a run while another process plays it: how it goes, and one robot's mind step by step."""

import time
from collections import deque
from collections.abc import Iterator
from contextlib import AbstractContextManager, nullcontext
from dataclasses import dataclass
from pathlib import Path
from typing import Protocol

from rich.console import Console
from rich.live import Live
from rich.text import Text

from asp.language import suggestion
from testbed.config import ExperimentConfig
from testbed.experiment.errors import StoreError
from testbed.experiment.live_run import LiveRun, Played
from testbed.experiment.lock import is_written
from testbed.experiment.narration import narrator_in
from testbed.experiment.progress import in_line
from testbed.experiment.record import OUTCOMES
from testbed.experiment.status import RunStatus
from testbed.experiment.stories import Story
from testbed.experiment.timeline import in_words, of_place
from testbed.text import Say, counted, plain


@dataclass(frozen=True)
class Choice:
    """Whose stories are told: one robot's, or all; with `failures` those that went wrong first."""

    robot: str | None = None
    failures: bool = False


@dataclass(frozen=True)
class Look:
    """A run at a moment; `rate` is in trials per second, None where it is not known."""

    run: LiveRun
    choice: Choice
    rate: float | None
    is_last: bool

    def status(self) -> list[str]:
        """How far the run is, and how the trials of each robot came out."""
        return [in_line(self.run.status, self.rate), *self._outcomes()]

    def _outcomes(self) -> Iterator[str]:
        for robot, counts in self.run.outcomes.items():
            told = (f"{counts[own]} {in_words(own)}" for own in OUTCOMES if counts[own])
            yield f"  {robot}: {', '.join(told) or 'no trial yet'}"

    def next_story(self) -> "Told | None":
        """The story to tell next; None where there is none that is new."""
        chosen = self.run.next_story(self.choice.robot, self.choice.failures)
        return None if chosen is None else Told(self.run, *chosen)


class Told:
    """A story as it is told: first whose it is, then step by step, at last what came out."""

    def __init__(self, run: LiveRun, trial: Played, story: Story) -> None:
        under = f", {trial.cell}" if trial.cell else ""
        where = of_place(trial.scenario, trial.level)
        self.head = f"trial {trial.trial}: {where}{under}, {trial.robot}; {' '.join(trial.goal)}"
        reason = f": {trial.reason}" if trial.reason else ""
        self._end = f"outcome {in_words(trial.outcome)}{reason}, {counted(trial.steps, 'step')}"
        self._said: list[str] = []
        self._narrator = narrator_in(run.refinement(trial), self._said.append)
        self._left = deque(story.steps)

    @property
    def is_over(self) -> bool:
        """Whether all steps are told."""
        return not self._left

    def step(self) -> list[str]:
        """The lines of the next step; after the last one the outcome."""
        self._said.clear()
        if self._left:
            self._narrator.tell(self._left.popleft())
        return [*self._said, *([] if self._left else ["", self._end])]


class View(Protocol):
    """Where a run is shown."""

    def opened(self) -> AbstractContextManager[object]:
        """For as long as the run is shown."""

    def show(self, look: Look) -> None:
        """Show the run as it is now."""


class Lines:
    """Lines for a file or a pipe: how the run goes where that is new, and whole stories."""

    def __init__(self, say: Say) -> None:
        self._say = say
        self._status: list[str] = []

    def opened(self) -> AbstractContextManager[object]:
        """Nothing to open."""
        return nullcontext()

    def show(self, look: Look) -> None:
        """The status if it is another one, then the story to tell next."""
        status = look.status()
        if status != self._status:
            self._status = status
            for line in status:
                self._say(line)
        told = look.next_story()
        if told is None:
            return
        self._say("")
        self._say(told.head)
        while not told.is_over:
            for line in told.step():
                self._say(line)
        self._say("")


class Screen:
    """A terminal, on which the status stays in its place, and a story goes on with each look."""

    def __init__(self, console: Console) -> None:
        self._live = Live(console=console, auto_refresh=False, vertical_overflow="ellipsis")
        self._told: Told | None = None
        self._step: list[str] = []

    def opened(self) -> AbstractContextManager[object]:
        """Live, and the last picture stays when it ends."""
        return self._live

    def show(self, look: Look) -> None:
        """The status, and the next step of the story; its rest where this is the last look."""
        if self._told is None or self._told.is_over:
            self._told = look.next_story() or self._told
        told = self._told
        while told is not None and not told.is_over:
            self._step = told.step()
            if not look.is_last:
                break
        lines = [*look.status(), "", *([] if told is None else [told.head, *self._step])]
        self._live.update(Text(plain("\n".join(lines), keep="\n")), refresh=True)


def watch(
    folder: Path, config: ExperimentConfig, choice: Choice, view: View, every: float, once: bool
) -> RunStatus:
    """Show a run every so many seconds until it is over; with `once` only as it is now.

    How it stood at the last look is returned.

    Raises StoreError for a robot that the run does not have.
    """
    if choice.robot is not None and choice.robot not in config.robots:
        hint = suggestion(choice.robot, config.robots)
        raise StoreError(f"--robot {choice.robot}: is not a robot of this run; {hint}")
    run, clock = LiveRun(folder, config), _Clock()
    with view.opened():
        while True:
            is_played = is_written(folder)  # before the look, which so has all of a run that ended
            run.look()
            is_last = once or not is_played
            view.show(Look(run, choice, clock.rate(run) if is_played else None, is_last))
            if is_last:
                return run.status
            time.sleep(every)


class _Clock:
    """Measures the rate since the run began; of one that went on, since the first look."""

    def __init__(self) -> None:
        self._began: tuple[float, int] | None = None

    def rate(self, run: LiveRun) -> float | None:
        """Trials per second; None where it is not known yet."""
        now, done = time.time(), run.status.done
        if self._began is None:
            self._began = (now, done) if run.began is None else (run.began, 0)
        since, before = self._began
        return (done - before) / (now - since) if now > since and done > before else None
