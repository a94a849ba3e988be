"""A session of the command line over the folder of a search."""

import shlex
import sys
from collections.abc import Iterator
from pathlib import Path

from testbed.config import ExperimentConfig
from testbed.experiment.interrupts import stoppable
from testbed.experiment.lock import locked
from testbed.experiment.provenance import Provenance
from testbed.experiment.run_folder import CONFIG, begin_or_resume, choose_folder
from testbed.stress.catalogue import Kind
from testbed.stress.progress import in_line, progress
from testbed.stress.running import Status, search
from testbed.stress.stories import TESTS, told, write_stories
from testbed.text import Printer, Say, counted


def stress_session(
    config: ExperimentConfig, out: Path | None, workers: int, resume: bool, quiet: bool
) -> int:
    """Search, write the stories and tell them; the exit code.

    Raises:
        StoreError: before anything is played.
        WorkerError: where no episode can be played.
    """
    folder = choose_folder(out, f"{config.name}-stress", resume)
    go_on = ["testbed", "stress", str(folder / CONFIG), "--out", str(folder), "--resume"]
    with locked(folder), stoppable(f"to go on: {shlex.join(go_on)}", quiet):
        begin_or_resume(folder, config, resume)
        provenance = Provenance(folder, config, ["testbed", *sys.argv[1:]])
        with progress(config.stress.minutes, quiet) as notify:
            status = search(config, folder, workers, notify)
        provenance.close(status.exit_code, workers)
        _conclude(folder, config, status, Printer(quiet))
        if status.interrupted:
            Printer(quiet)(f"interrupted; to go on: {shlex.join(go_on)}")
    return status.exit_code


def _conclude(folder: Path, config: ExperimentConfig, status: Status, say: Say) -> None:
    paths = write_stories(folder, config, status.stories)
    for kind, path in paths.items():
        for line in ("", *_told(kind, path, status)):
            say(line)
    say("")
    say(in_line(status))
    if paths:
        say(f"tests of these stories: python -m pytest {shlex.quote(str(folder / TESTS))}")
    elif not status.interrupted:
        left = status.cases - status.catalogue.cases
        but = f", and {counted(left, 'case')} are not explored" if left else ""
        say(f"nothing was found{but}; {folder} has what was played")


def _told(kind: Kind, path: Path, status: Status) -> Iterator[str]:
    met = sum(n for own, n in status.catalogue.met.items() if own[:3] == kind[:3])
    yield from told(kind, status.stories[kind], met)
    yield f"  replay  testbed run {shlex.quote(str(path))}"
