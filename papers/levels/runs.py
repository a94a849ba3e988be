"""A run folder of the levels: its columns and its pairs."""

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

from papers.levels.pairing import Pair, pairs_in
from testbed.analysis import load_run
from testbed.config import ExperimentConfig
from testbed.experiment import StoreError
from testbed.experiment.run_folder import read_config
from testbed.studies.levels.measures import Level, Levels, analyse
from testbed.studies.levels.published import NO_ZOOM, PAPER, ZOOM


@dataclass(frozen=True)
class Run:
    """A run of both conditions: its columns and its pairs, by level."""

    folder: Path
    config: ExperimentConfig
    levels: Mapping[str, Level]
    pairs: Mapping[str, list[Pair]]

    @property
    def beside(self) -> Levels:
        """The columns, to be compared with the published ones."""
        return Levels(self.levels, PAPER)

    @property
    def all_pairs(self) -> list[Pair]:
        """The pairs of all levels."""
        return [pair for own in self.pairs.values() for pair in own]


def read_run(folder: Path) -> Run:
    """The run in a folder, also one whose configuration does not name the protocol.

    Raises:
        StoreError: for a folder without a run, or without pairs of both conditions.
        ConfigError: where the stored configuration is not valid any more.
    """
    config, trials = read_config(folder), load_run(folder).trials
    pairs: dict[str, list[Pair]] = {}
    for pair in pairs_in(trials):
        pairs.setdefault(pair.level, []).append(pair)
    if not pairs:
        raise StoreError(f"{folder}: has no pairs of {ZOOM} and {NO_ZOOM} at levels on record")
    return Run(folder, config, analyse(trials), pairs)
