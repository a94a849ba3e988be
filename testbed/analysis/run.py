"""A run: what `load_run` reads of its folder."""

from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import Any

import polars as pl

from testbed.analysis.stored_table import Table, read_table
from testbed.analysis.table import records_of
from testbed.config import ExperimentConfig, conditions_of
from testbed.experiment.provenance import read_provenance
from testbed.experiment.record import TrialRecord
from testbed.experiment.run_folder import read_config


@dataclass(frozen=True)
class Run:
    """A run folder as it was read: its configuration, provenance and trials.

    `table` has one row per trial on record, in the order in which they ended, and one column per
    key of a record; what is nested there is a list or a struct here. It is compressed, and of a
    query only the columns that it needs are not. `provenance` is what `provenance.json` holds,
    empty where that is not known; `digest` is that of all results.
    """

    folder: Path
    config: ExperimentConfig
    provenance: dict[str, Any]
    table: pl.LazyFrame
    digest: str

    @cached_property
    def trials(self) -> pl.DataFrame:
        """The whole table."""
        return self.table.collect()

    def records(self, *conditions: pl.Expr) -> Iterator[TrialRecord]:
        """The rows as records, one at a time; with conditions those that satisfy all of them."""
        return records_of(self.table.filter(*conditions))

    @cached_property
    def conditions(self) -> dict[str, ExperimentConfig]:
        """The configuration under each condition of its sweep, by name; of no sweep by ""."""
        return conditions_of(self.config)


def load_run(folder: str | Path) -> Run:
    """Read a run folder, each record at most once; also while the run goes on.

    Raises:
        StoreError: for a folder without a run, and for a damaged record, with its line.
        ConfigError: where the stored configuration is not valid any more.
    """
    folder = Path(folder)
    return run_of(folder, read_config(folder), read_table(folder))


def run_of(folder: Path, config: ExperimentConfig, table: Table) -> Run:
    """The run with this configuration and this table."""
    known = read_provenance(folder)
    return Run(folder, config, known, table.rows, table.digest)
