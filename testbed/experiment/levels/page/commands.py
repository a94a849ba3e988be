"""The commands that make a run, its page and its picture again."""

from __future__ import annotations

import json
import shlex
from pathlib import Path

from testbed.config import ExperimentConfig, load_config
from testbed.experiment.levels.protocol import PROTOCOL
from testbed.experiment.store import PROVENANCE, flat_config

PAGE, PICTURE = "docs/levels-published-and-measured.md", "docs/images/levels.svg"


def commands(folder: Path, config: ExperimentConfig) -> str:
    """The run, with as many workers as it had where that is on record; what is made of it."""
    workers = workers_of(folder)
    run = ["testbed", "run", *_arguments(config)]
    run += [] if workers is None else ["--workers", str(workers)]
    where = place(config)
    return "\n".join(
        [
            f"$ {shlex.join(run)}",
            f"$ python -m testbed.experiment.levels {where} > {PAGE}",
            f"$ python -m testbed.experiment.report {where} {PICTURE}",
        ]
    )


def place(config: ExperimentConfig) -> str:
    """The folder in which the first command puts the run."""
    return shlex.quote(f"runs/{config.name}")


def workers_of(folder: Path) -> int | None:
    """How many processes played the last session of a run; None where it is not on record."""
    path = folder / PROVENANCE
    kept = json.loads(path.read_text(encoding="utf-8")) if path.is_file() else {}
    workers = kept.get("workers")
    return workers if isinstance(workers, int) else None


def _arguments(config: ExperimentConfig) -> list[str]:
    """The packaged configuration, and what differs from it."""
    packaged, own = flat_config(load_config(PROTOCOL)), flat_config(config)
    changed = [key for key in own if own[key] != packaged.get(key)]
    return [PROTOCOL, *(f"{key}={_value(own[key])}" for key in changed)]


def _value(value: object) -> str:
    if isinstance(value, list | tuple):
        return "[" + ",".join(map(str, value)) + "]"
    return str(value).lower() if isinstance(value, bool) else str(value)
