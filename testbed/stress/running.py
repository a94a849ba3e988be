"""Conduct a search in a folder: play units, keep the journal, shrink and write what was found."""

import json
import time
from collections import Counter
from collections.abc import Callable, Sequence
from concurrent.futures import Executor
from concurrent.futures.process import BrokenProcessPool
from dataclasses import dataclass, field
from pathlib import Path

from testbed.config import ExperimentConfig
from testbed.experiment.errors import WorkerError
from testbed.experiment.interrupts import INTERRUPTED, uninterrupted
from testbed.experiment.run_folder import SUMMARY, replace_text
from testbed.experiment.snapshots import SnapshotError
from testbed.experiment.specs import TrialSpec
from testbed.stress.cases import cases_of
from testbed.stress.catalogue import Catalogue, Example, Group, Kind
from testbed.stress.executors import executor_of
from testbed.stress.journal import Journal
from testbed.stress.search import Search, results
from testbed.stress.shrinking import Shrunk, shrunk


@dataclass
class Status:
    """A search as it stands: `cases` of the plan, what was found, and when (seconds) for the first
    time; whether it was interrupted. `stories` are the shrunk episodes, one per kind, once it is
    over.
    """

    cases: int
    catalogue: Catalogue = field(default_factory=Catalogue)
    seconds: float = 0.0
    first_s: dict[Kind, float] = field(default_factory=dict)
    interrupted: bool = False
    stories: dict[Kind, Shrunk] = field(default_factory=dict)

    @property
    def exit_code(self) -> int:
        """0 where nothing was found, 1 where something was, 130 where it was interrupted."""
        return INTERRUPTED if self.interrupted else int(bool(self.catalogue.kinds))


Notify = Callable[[Status], None]


def search(config: ExperimentConfig, folder: Path, workers: int, notify: Notify) -> Status:
    """Search for `stress.minutes`, or until all is explored; go on from the folder's journal.

    What the journal has takes none of these minutes. An interrupt ends it early; what was played is
    kept. `notify` is called after every unit.

    Raises:
        StoreError: for a journal that is none.
        WorkerError: where no unit can be played, for a robot that cannot go back, or where a
            process that plays a unit is lost.
    """
    cases, journal = cases_of(config), Journal(folder)
    status = Status(len(cases))
    with executor_of(config, workers) as executor:
        began = time.monotonic()
        try:
            notify(status)
            _play(config, cases, executor, journal, status, notify, began)
            status.stories = _shrunk(config, executor, status.catalogue)
        except KeyboardInterrupt:
            status.interrupted = True
        except SnapshotError as error:
            raise WorkerError(f"robots: {error}") from None
        except BrokenProcessPool:
            told = "a process that played an episode was ended from outside; --resume goes on"
            raise WorkerError(told) from None
    if not (status.catalogue.units or status.interrupted):
        minutes = f"stress.minutes: {config.stress.minutes:g}"
        raise WorkerError(f"{minutes} is over before any episode was played; give more")
    status.seconds = time.monotonic() - began
    status.stories = status.stories or _as_found(status.catalogue)
    replace_text(folder / SUMMARY, json.dumps(summary(status), indent=2) + "\n")
    return status


def _play(
    config: ExperimentConfig,
    cases: Sequence[TrialSpec],
    executor: Executor,
    journal: Journal,
    status: Status,
    notify: Notify,
    began: float,
) -> None:
    until = began + 60 * config.stress.minutes
    played = results(
        Search(config, cases), executor, journal.known, lambda: time.monotonic() < until
    )
    for unit, result in played:
        with uninterrupted():
            journal.add(unit, result)
            new = status.catalogue.hear(unit, result)
        status.seconds = time.monotonic() - began
        status.first_s |= dict.fromkeys(new, status.seconds)
        notify(status)


def _shrunk(
    config: ExperimentConfig, executor: Executor, catalogue: Catalogue
) -> dict[Kind, Shrunk]:
    """The simplest story of each kind; kinds that become the same by it are one."""
    pending = []
    for kind, own in sorted(catalogue.kinds.items()):
        episode = own.case, own.judged.events
        future = executor.submit(shrunk, config.seed, *episode, config.stress, own.finding)
        pending.append((kind, own, future))
    stories: dict[Kind, Shrunk] = {}
    for kind, own, future in pending:
        story = future.result() or _as_met(own, repeated=False)
        stories.setdefault(kind._replace(events=_names(story)), story)
    return stories


def _as_found(catalogue: Catalogue) -> dict[Kind, Shrunk]:
    return {kind: _as_met(own) for kind, own in sorted(catalogue.kinds.items())}


def _as_met(found: Example, repeated: bool = True) -> Shrunk:
    own = found.judged
    return Shrunk(found.case, own.events, own.length, own.chance, found.finding, repeated)


def _names(story: Shrunk) -> tuple[str, ...]:
    return tuple(event.name for _, event in story.events)


def summary(status: Status) -> dict[str, object]:
    """The numbers of a search, for `summary.json`."""
    found = status.catalogue
    return {
        "cases": status.cases,
        "cases_explored": found.cases,
        "most_events": found.most_events,
        "units": found.units,
        "events_left_out": found.left_out,
        "seconds": round(status.seconds, 3),
        "episodes": _by_robot(found.episodes),
        "with_findings": _by_robot(found.failed),
        "groups": [
            {**own._asdict(), "episodes": number, "with_findings": found.failed[own]}
            for own, number in sorted(found.episodes.items())
        ],
        "greatest_score": dict(sorted(found.greatest.items())),
        "kinds": [
            {
                **kind._asdict(),
                "episodes": number,
                "conditions": sorted(found.under[kind]),
                "first_after_s": round(status.first_s.get(kind, 0.0), 3),
            }
            for kind, number in sorted(found.met.items())
        ],
    }


def _by_robot(numbers: Counter[Group]) -> dict[str, int]:
    robots = sorted({own.robot for own in numbers})
    return {name: sum(n for own, n in numbers.items() if own.robot == name) for name in robots}
