"""Run folders of Table 1 as the page reads them: their pairs, whatever was published beside."""

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from pathlib import Path

from papers.table1.pairs import Pair, each
from testbed.analysis import load_run
from testbed.analysis.comparison import eventful
from testbed.analysis.population import exhausted
from testbed.config import ExperimentConfig
from testbed.experiment import StoreError
from testbed.experiment.run_folder import read_config
from testbed.studies.table1.measures import Analysis, analyse, comparisons_of
from testbed.studies.table1.pairs import pairs_in
from testbed.studies.table1.published import BASELINE, INTENTIONAL
from testbed.world import load_world

PROTOCOL = "table1"
TOLD = "told"


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
    run, world = load_run(folder), load_world(config.domain)
    pairs = {
        robots: pairs_in(run.trials, world, robots, eventful(config))
        for robots in comparisons_of(config)
    }
    if not any(map(len, pairs.values())):
        robots = f"{INTENTIONAL} and {BASELINE}"
        raise StoreError(f"{folder}: has no pairs of {robots} on record")
    return Run(
        folder,
        config,
        {robots.treatment: list(each(own)) for robots, own in pairs.items()},
        {
            robots.treatment: analyse(own, robots, exhaustive=exhausted(run))
            for robots, own in pairs.items()
        },
    )


def told_name(order: Iterable[str]) -> str:
    """The name of a run of `benchmarks/told.py` with this order of places; none: the domain's."""
    return "-".join((TOLD, *order))


def told_order(run: Run) -> list[str]:
    """The order that `told_name` was given.

    Raises:
        StoreError: for any other name: it is TOLD, alone or with all members of a sort.
    """
    own, *order = run.config.name.split("-")
    sorts = load_world(run.config.domain).description.sorts.values()
    if own == TOLD and (not order or sorted(order) in map(sorted, sorts)):
        return order
    raise StoreError(
        f"{run.folder}: name: {run.config.name} is not that of a run of benchmarks/told.py; "
        f"it would be {TOLD}, or {TOLD}- and all members of a sort of the domain"
    )
