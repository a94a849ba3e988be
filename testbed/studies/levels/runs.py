"""A run folder of the levels: its columns and its pairs."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

from testbed.config import ExperimentConfig
from testbed.experiment.errors import StoreError
from testbed.experiment.store import read_config, read_records
from testbed.studies.levels.analysis import analyse
from testbed.studies.levels.outline import FineOutline, fine_outline
from testbed.studies.levels.pairing import Pair, pairs_of
from testbed.studies.levels.published import NO_ZOOM, ZOOM
from testbed.studies.levels.results import Level


@dataclass(frozen=True)
class Run:
    """A run of both conditions: its columns and its pairs, by level."""

    folder: Path
    config: ExperimentConfig
    levels: Mapping[str, Level]
    pairs: Mapping[str, list[Pair]]

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
    config = read_config(folder)
    pairs: dict[str, list[Pair]] = {}
    for pair in pairs_of(read_records(folder)):
        pairs.setdefault(pair.level, []).append(pair)
    if not pairs:
        raise StoreError(f"{folder}: has no pairs of {ZOOM} and {NO_ZOOM} at levels on record")
    return Run(folder, config, analyse(_outlines(folder)), pairs)


def _outlines(folder: Path) -> dict[str, list[FineOutline]]:
    levels: dict[str, list[FineOutline]] = {}
    for record in read_records(folder):
        if record.fine is not None and record.counts:
            levels.setdefault(record.level, []).append(fine_outline(record, record.fine))
    return levels
