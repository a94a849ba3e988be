"""Wait until a run has begun."""

import time
from pathlib import Path

from testbed.config import ExperimentConfig
from testbed.experiment.lock import LOCK, is_written
from testbed.experiment.run_folder import CONFIG, read_config
from testbed.text import Say


def wait_for_run(folder: Path, say: Say, every: float, once: bool) -> ExperimentConfig:
    """The configuration of the run in a folder, as soon as one is there.

    Raises:
        StoreError: for a folder that holds something else, and with `once` where none is there.
        ConfigError: where the configuration is not valid any more.
    """
    waits = not once and _may_become_run(folder)
    if waits:
        say(f"waiting for a run in {folder}")
    while waits:
        time.sleep(every)
        waits = _may_become_run(folder)
    return read_config(folder)


def _may_become_run(folder: Path) -> bool:
    """Whether there is nothing but what a run begins with."""
    if (folder / CONFIG).is_file():
        return False
    if not folder.is_dir():
        return not folder.exists()
    return is_written(folder) or {own.name for own in folder.iterdir()} <= {LOCK}
