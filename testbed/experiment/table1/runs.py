"""The pairs of a run folder, by what its configuration says of it."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from pathlib import Path

from testbed.config import ExperimentConfig
from testbed.experiment.counting import BASELINE, INTENTIONAL, eventful
from testbed.experiment.domains import load_world
from testbed.experiment.errors import StoreError
from testbed.experiment.record import TrialRecord
from testbed.experiment.store import read_config, read_records
from testbed.experiment.table1.analysis import Analysis, analyse
from testbed.experiment.table1.pairing import Pair, pairs_of

PROTOCOL = "table1"


@dataclass(frozen=True)
class Run:
    """A run of the protocol: its pairs and their analysis, by the robot beside the baseline."""

    folder: Path
    config: ExperimentConfig
    pairs: Mapping[str, list[Pair]]
    analyses: Mapping[str, Analysis]

    @property
    def minds(self) -> tuple[str, ...]:
        """The robots that are compared with the baseline."""
        return tuple(self.pairs)


def read_run(folder: Path) -> Run:
    """The run in a folder.

    Raises:
        StoreError: for a folder without a run, one of another protocol, or one without pairs.
        ConfigError: where the stored configuration is not valid any more.
    """
    config = read_config(folder)
    if config.protocol != PROTOCOL:
        raise StoreError(f"{folder}: its configuration has no `protocol: {PROTOCOL}`")
    pairs = {mind: _pairs(read_records(folder), config, mind) for mind in minds_of(config)}
    if not any(pairs.values()):
        robots = f"{INTENTIONAL} and {BASELINE}"
        raise StoreError(f"{folder}: has no pairs of {robots} on record")
    sure = eventful(config)
    analyses = {mind: analyse(own, mind, BASELINE, sure) for mind, own in pairs.items()}
    return Run(folder, config, pairs, analyses)


def minds_of(config: ExperimentConfig) -> tuple[str, ...]:
    """The robots of a configuration with activities, where the baseline is there, too."""
    if BASELINE not in config.robots:
        return ()
    return tuple(name for name in config.robots if name.startswith(INTENTIONAL))


def _pairs(records: Iterable[TrialRecord], config: ExperimentConfig, mind: str) -> list[Pair]:
    return list(pairs_of(records, load_world(config.domain), mind, BASELINE))
