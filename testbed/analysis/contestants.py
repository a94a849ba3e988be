"""Any two robots, conditions or runs compared, over trials from the same starts and seeds."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace

import polars as pl

from asp.language import suggestion
from testbed.analysis.bootstrap import Estimate
from testbed.analysis.comparison import MEASURES, compared, eventful, measured, with_apart
from testbed.analysis.pairs import OTHER, Compared, Sample, cluster_of, corrected, pairs_of
from testbed.analysis.population import exhausted_under
from testbed.analysis.run import Run
from testbed.analysis.statistics import Test
from testbed.experiment import StoreError
from testbed.experiment.record import COARSE

ALL, CONDITIONS = "all", "all conditions"
"""The place of a comparison over all scenarios or levels; and over all conditions of a sweep."""
START = ("scenario", "level", "seed", "start", "goal")
"""What two trials have in common that are a pair; robots and conditions may differ."""
MARK = " / "
"""Between the parts of a contestant's name."""


@dataclass(frozen=True)
class Divided:
    """The mean of a measure of the baseline divided by the treatment's, and the test of both."""

    mean: Estimate | None
    test: Test | None


@dataclass(frozen=True)
class Contrast:
    """A baseline and a treatment in one place: a scenario, a level, or all of them.

    `pairs` count; `baseline` and `treatment` are the shares of trials that achieve the goal, `test`
    McNemar's test of these; `ratios`, by measure, are of the baseline to the treatment over the
    pairs in which both achieve it, each with Wilcoxon's test. `condition` is the sweep's that both
    are of, "" where it is not one.
    """

    robots: Compared
    place: str
    pairs: int
    baseline: Estimate | None
    treatment: Estimate | None
    test: Test | None
    ratios: Mapping[str, Divided]
    condition: str = ""

    @property
    def names(self) -> Compared:
        """What is compared, without the condition that both are of."""
        return Compared(*(_without(name, self.condition) for name in self.robots))


def contrasts(
    runs: Sequence[Run], baseline: str | None = None, treatment: str | None = None
) -> list[Contrast]:
    """Comparisons by place and over all places, with Holm's correction over all of their tests.

    What is compared is a robot, under a condition if its run is swept, of a run if there are
    several: it is named by these, as in `slow / rate=0.5 / intentional`. Without names the robots
    of a run are compared under each condition, as its configuration says, and over all conditions;
    of several runs each robot with itself in the first run. With a `baseline` alone every other one
    is compared with it; a `treatment` alone is compared with the first.

    Raises:
        StoreError: for a name that is none of theirs, and where there is nothing to compare.
    """
    labels = _labels(runs)
    trials = pl.concat(_trials(*own) for own in zip(runs, labels, strict=True))
    sure = frozenset(name for run in runs for name in eventful(run.config))
    names = trials["robot"].unique(maintain_order=True).to_list()
    if baseline is None and treatment is None:
        asked = list(_asked(runs, labels))
    else:
        base = names[0] if baseline is None else _known(baseline, names)
        others = names if treatment is None else [_known(treatment, names)]
        asked = [Compared(base, other) for other in others if other != base]
    if not asked:
        several = "the runs have no robot in common under the same condition"
        why = several if len(runs) > 1 else f"there is only {names[0]}"
        raise StoreError(f"nothing to compare: {why}; name two by --baseline and --treatment")
    cells = dict(_cells(runs, labels))
    found = [
        replace(own, condition=_common(robots, cells))
        for robots in asked
        for own in _by_place(trials, robots, sure)
    ]
    if baseline is None and treatment is None and len(runs) == 1 and runs[0].config.is_sweep:
        found += _over_conditions(runs[0], sure)
    return corrected(found)


def _labels(runs: Sequence[Run]) -> list[str]:
    """What the runs are called; "" for a single one. Raises StoreError for one given twice."""
    if len(runs) == 1:
        return [""]
    places = Counter(run.folder.resolve() for run in runs)
    for place, times in places.items():
        if times > 1:
            raise StoreError(f"{place}: is given twice; a run is compared with another one")
    names = Counter(place.name for place in places)
    return [
        place.name if names[place.name] == 1 else str(run.folder)
        for run, place in zip(runs, places, strict=True)
    ]


def _asked(runs: Sequence[Run], labels: Sequence[str]) -> Iterator[Compared]:
    """What is compared where no names are given."""
    (first, label), *others = zip(runs, labels, strict=True)
    if not others:
        for own in compared(first.config) if first.config.comparisons else ():
            for cell in first.conditions:
                yield Compared(*(_name(first, label, cell, robot) for robot in own))
    for other, its in others:
        for cell in first.conditions.keys() & other.conditions.keys():
            for robot in first.config.robots:
                if robot in other.config.robots:
                    both = ((first, label), (other, its))
                    yield Compared(*(_name(run, own, cell, robot) for run, own in both))


def _name(run: Run, label: str, cell: str, robot: str) -> str:
    return MARK.join([*[label] * bool(label), *[cell] * run.config.is_sweep, robot])


def _cells(runs: Sequence[Run], labels: Sequence[str]) -> Iterator[tuple[str, str]]:
    """The names of what runs hold, each with its condition."""
    for run, label in zip(runs, labels, strict=True):
        for cell in run.conditions:
            yield from ((_name(run, label, cell, robot), cell) for robot in run.config.robots)


def _common(robots: Compared, cells: Mapping[str, str]) -> str:
    """The condition that both are of, "" where they are not of one."""
    cell, *others = {cells.get(name, "") for name in robots}
    return "" if others else cell


def _without(name: str, cell: str) -> str:
    return name.replace(f"{cell}{MARK}", "", 1) if cell else name


def _known(name: str, names: Sequence[str]) -> str:
    if name in names:
        return name
    raise StoreError(f"'{name}' is none of what the runs hold; {suggestion(name, names)}")


def _trials(run: Run, label: str) -> pl.DataFrame:
    """The measured trials of a run; `robot` is the name of what is compared, `pair` the start."""
    parts = [pl.lit(label)] * bool(label) + [pl.col("cell")] * run.config.is_sweep
    named = run.table.with_columns(robot=pl.concat_str([*parts, pl.col("robot")], separator=MARK))
    return _paired(run, named, START)


def _paired(run: Run, trials: pl.LazyFrame, key: Sequence[str]) -> pl.DataFrame:
    """Measured trials of a run, whose `pair` is what these columns hold.

    `whole`: they are of a scenario whose population is played exhaustively.
    """
    whole = [
        pl.col("scenario").is_in(own) & (pl.col("cell") == cell)
        for cell, own in exhausted_under(run).items()
    ]
    told = trials.with_columns(
        start=pl.col("initial").list.join(" "), goal=pl.col("goal").list.sort().list.join(" ")
    )
    found = measured(told.with_columns(pair=pl.concat_str(key, separator=MARK)))
    return found.with_columns(whole=pl.any_horizontal(whole))


def _over_conditions(run: Run, sure: frozenset[str]) -> Iterator[Contrast]:
    """The robots of a swept run over all of its conditions, under each of which a start counts."""
    trials = _paired(run, run.table, ("cell", *START))
    for robots in compared(run.config):
        yield _contrast(_counted(trials, robots, sure), robots, CONDITIONS)


def _by_place(trials: pl.DataFrame, robots: Compared, sure: frozenset[str]) -> Iterator[Contrast]:
    """In each scenario or level, and in all where there are several."""
    pairs = _counted(trials, robots, sure)
    place = pl.when(pl.col("level") == COARSE).then("scenario").otherwise("level")
    groups = pairs.with_columns(place=place).partition_by("place", as_dict=True)
    for (name,), group in groups.items():
        yield _contrast(group, robots, str(name))
    if len(groups) != 1:
        yield _contrast(pairs, robots, ALL)


def _counted(trials: pl.DataFrame, robots: Compared, sure: frozenset[str]) -> pl.DataFrame:
    """The pairs of two contestants that count."""
    own = trials.filter(pl.col("robot").is_in(robots))
    return pairs_of(with_apart(own, robots, sure).filter(pl.col("apart").is_null()), robots)


def _contrast(pairs: pl.DataFrame, robots: Compared, place: str) -> Contrast:
    whole = pairs.select("whole", "whole" + OTHER).to_numpy().all()
    sample = Sample(pairs, cluster_of(pairs), whole=bool(whole))
    both = sample.achieved
    return Contrast(
        robots,
        place,
        len(pairs),
        sample.share("achieved"),
        sample.share("achieved" + OTHER),
        sample.mcnemar("achieved"),
        {name: Divided(both.mean_ratio(name), both.signed_rank(name)) for name in MEASURES},
    )
