"""The commands that make a run, its page and its picture again."""

import shlex
from pathlib import Path

from papers.commands import arguments, workers_of
from papers.commands import place as place_of
from testbed.config import ExperimentConfig

PROTOCOL = "levels"
PAGE, PICTURE = "docs/levels-published-and-measured.md", "docs/images/levels.svg"


def commands(folder: Path, config: ExperimentConfig) -> str:
    """The run, with as many workers as it had where that is on record; what is made of it."""
    workers = workers_of(folder)
    run = ["testbed", "run", *arguments(config, PROTOCOL)]
    run += [] if workers is None else ["--workers", str(workers)]
    where = place(config)
    return "\n".join(
        [
            f"$ {shlex.join(run)}",
            f"$ python -m papers.levels {where} > {PAGE}",
            f"$ python -m papers {where} {PICTURE}",
        ]
    )


def place(config: ExperimentConfig) -> str:
    """The folder in which the first command puts the run, for a shell."""
    return shlex.quote(place_of(config))
