"""Configurations that may be run here: with the robots that there are."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from testbed.cli.importing import search_last
from testbed.config import ExperimentConfig, load_config
from testbed.experiment.robots import STARTERS, known_robots


def load(source: str | Path, overrides: Sequence[str] = ()) -> ExperimentConfig:
    """The configuration of a file or a packaged name, with overrides. Raises ConfigError.

    What lies beside the file can be imported from then on, but nothing in the place of ours.
    """
    config = load_config(source, overrides, known_robots, starters=STARTERS)
    if Path(source).is_file():
        search_last(Path(source).resolve().parent)
    return config
