"""How a search goes on, told on standard error: episodes, their rate, what was found, time left."""

import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager

from rich.console import Console
from rich.progress import BarColumn, Progress, TextColumn, TimeRemainingColumn

from testbed.stress.catalogue import Kind
from testbed.stress.running import Notify, Status
from testbed.text import Say, counted, warn

EVERY_S = 30.0


@contextmanager
def progress(minutes: float, quiet: bool) -> Iterator[Notify]:
    """A bar where standard error is a terminal; elsewhere a line from time to time.

    What is found is said at once, by its kind.
    """
    console = Console(stderr=True)
    if quiet:
        yield lambda _: None
    elif console.is_terminal:
        columns = TextColumn("{task.description}"), BarColumn(), TimeRemainingColumn()
        with Progress(*columns, console=console) as bar:
            task = bar.add_task("search", total=60 * minutes)
            news = News(lambda line: bar.console.print(line, markup=False, highlight=False))

            def notify(status: Status) -> None:
                news.notify(status)
                bar.update(task, completed=status.seconds, description=in_line(status))

            yield notify
    else:
        yield Lines(warn).notify


class News:
    """Says each kind of finding once, when it is met for the first time."""

    def __init__(self, say: Say) -> None:
        self._say = say
        self._known: set[Kind] = set()

    def notify(self, status: Status) -> None:
        """Told at the start and after every unit."""
        for kind in status.first_s.keys() - self._known:
            self._say(f"found after {status.first_s[kind]:.1f} s: {kind}")
        self._known.update(status.first_s)


class Lines:
    """The same in plain lines, with how far the search is every `EVERY_S` seconds."""

    def __init__(self, say: Say, clock: Callable[[], float] = time.monotonic) -> None:
        self._say, self._clock, self._news = say, clock, News(say)
        self._due = clock() + EVERY_S

    def notify(self, status: Status) -> None:
        """Told at the start and after every unit."""
        self._news.notify(status)
        if self._clock() >= self._due:
            self._due = self._clock() + EVERY_S
            self._say(in_line(status))


def in_line(status: Status) -> str:
    """Cases that were explored with one event, episodes and most events, their rate, findings."""
    found = status.catalogue
    number = sum(found.episodes.values())
    episodes = f"{counted(number, 'episode')} with up to {counted(found.most_events, 'event')}"
    rate = f", {number / status.seconds:.0f}/s" if status.seconds else ""
    cases = f"{found.cases} of {counted(status.cases, 'case')}"
    return f"{cases}, {episodes}{rate}, {counted(len(found.kinds), 'kind')} found"
