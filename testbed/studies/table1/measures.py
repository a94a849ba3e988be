"""From pairs to Table 1: one row per scenario, all of them, and those in which nobody failed."""

from collections import Counter
from collections.abc import Collection, Iterator, Mapping
from dataclasses import dataclass, field, replace
from math import lcm

import polars as pl

from testbed.analysis import Run
from testbed.analysis.bootstrap import Estimate
from testbed.analysis.comparison import TIMES, Apart, eventful, optimum
from testbed.analysis.pairs import OTHER, Compared, Ratio, Sample, corrected
from testbed.analysis.population import exhausted
from testbed.analysis.statistics import Test
from testbed.config import ExperimentConfig
from testbed.studies.table1.pairs import Meeting, pairs_in
from testbed.studies.table1.published import (
    ALL,
    BASELINE,
    INTENTIONAL,
    MEASURES,
    NO_FAILURES,
    PUBLISHED,
    SCENARIOS,
    Published,
)
from testbed.world import load_world

RANDOM = "random"
EACH = dict.fromkeys(("triggered", "random"), PUBLISHED)
LEFT_OUT = {
    "failed": Apart.FAILED_PAIRS,
    "deadline": Apart.DEADLINE,
    "unsolvable": Apart.UNSOLVABLE,
}
"""Why pairs of a scenario do not count, by the keys of a summary."""


@dataclass(frozen=True)
class Seconds:
    """Seconds of process time per trial, the means of both robots, and what their ratio is."""

    baseline: float | None
    treatment: float | None
    ratio: Ratio


@dataclass(frozen=True)
class Row:
    """A row of the table; `pairs` are those counted, `left_out` the others by LEFT_OUT.

    `undecided` pairs count, but in no accuracy: of these it is not known whether both trials were
    correct.
    `whole` says that they are the whole population: their estimates have no interval.
    The test of the accuracies has its effect above 0 where the treatment was right more often;
    `advantage` is that difference of the proportions with its interval. `out_of_reach` are goals
    that could not be achieved any more where a trial ended. `optimum` is, by robot, what it needed
    over the least that achieves the goal, by measure, and of how many `trials`; `times` are by the
    name of the measure: planning, diagnosis, and both.
    """

    name: str
    pairs: int
    baseline: Estimate | None
    treatment: Estimate | None
    accuracy: Test | None
    ratios: Mapping[str, Ratio]
    meetings: Mapping[Meeting, int] = field(default_factory=dict)
    advantage: Estimate | None = None
    optimum: Mapping[str, Mapping[str, float | None]] = field(default_factory=dict)
    times: Mapping[str, Seconds] = field(default_factory=dict)
    left_out: Mapping[str, int] = field(default_factory=lambda: dict.fromkeys(LEFT_OUT, 0))
    undecided: int = 0
    out_of_reach: int = 0
    whole: bool = False


@dataclass(frozen=True)
class Table:
    """One way of assigning pairs to scenarios; `apart` counts the pairs that are in no row.

    `published` are the rows of the paper that it is to be compared with, by name.
    """

    rows: tuple[Row, ...]
    apart: Mapping[str, int]
    published: Mapping[str, Published] = field(default_factory=lambda: PUBLISHED)


@dataclass(frozen=True)
class Analysis:
    """What the pairs of two robots come to.

    `tables` are `triggered`, by the scenario that was played, and `random`, by the scenario that a
    random event came to be; one without pairs is absent. `became` counts the pairs by both: which
    scenario was played, and what it came to be.
    """

    robots: Compared
    tables: Mapping[str, Table]
    became: Mapping[str, Mapping[str, int]]


def measures(run: Run, as_published: bool) -> list[Analysis]:
    """Each robot with activities against the traditional one.

    The published figures are those of one robot; these of all scenarios together are of five.
    """
    world, sure = load_world(run.config.domain), eventful(run.config)
    whole = set(SCENARIOS) <= set(run.config.scenarios)
    parts = {name: row for name, row in PUBLISHED.items() if whole or not name.startswith(ALL)}
    paper = {"triggered": parts, "random": PUBLISHED}
    exhaustive = exhausted(run)
    return [
        analyse(
            pairs_in(run.table, world, robots, sure),
            robots,
            paper if as_published and robots.treatment == INTENTIONAL else {},
            exhaustive,
        )
        for robots in comparisons_of(run.config)
    ]


def comparisons_of(config: ExperimentConfig) -> list[Compared]:
    """Every other robot of a configuration with the baseline, if it is there."""
    if BASELINE not in config.robots:
        return []
    return [Compared(BASELINE, name) for name in config.robots if name != BASELINE]


def analyse(
    pairs: pl.DataFrame,
    robots: Compared,
    published: Mapping[str, Mapping[str, Published]] = EACH,
    exhaustive: Collection[str] = (),
) -> Analysis:
    """Both tables of `pairs_in`, beside these published rows.

    Of scenarios that are `exhausted` estimates have no interval.
    """
    # Failures and goals that nothing achieves are told in the row of their scenario.
    apart = pl.col("apart").is_in([Apart.NOTHING_TO_DO, Apart.WITHOUT_EVENT])
    drawn = pl.col("scenario") == RANDOM
    row = pl.when(drawn).then("happened").when(apart).then("apart").otherwise("scenario")
    placed = pairs.with_columns(row=row)
    ways = {"triggered": placed.filter(~drawn), "random": placed.filter(drawn)}
    became = {
        own["scenario"][0]: dict(sorted(Counter(own["happened"]).items()))
        for own in pairs.partition_by("scenario")
    }
    whole: Mapping[str, Collection[str]] = {"triggered": exhaustive, "random": ()}
    tables = {
        way: _table(own, robots, published.get(way, {}), whole[way])
        for way, own in ways.items()
        if len(own)
    }
    return Analysis(robots, tables, became)


def _table(
    pairs: pl.DataFrame,
    robots: Compared,
    published: Mapping[str, Published],
    exhaustive: Collection[str],
) -> Table:
    groups = dict(sorted(Counter(pairs["row"]).items()))
    scenarios = [name for name in groups if name.isdigit()]
    # Weights in whole numbers: sums of them are exact, and what is alike stays alike.
    whole = float(lcm(*Counter(pairs["scenario"]).values()))
    weighed = pairs.with_columns(weight=whole / pl.len().over("scenario"))
    sample = Sample(weighed.sort("row", maintain_order=True), weight="weight")
    rows = [
        _row(name, replace(sample.where(holds), whole=name in exhaustive), robots)
        for name, holds in _rows(scenarios)
    ]
    apart = {name: count for name, count in groups.items() if not name.isdigit()}
    return Table(tuple(corrected(rows)), apart, published)


def _rows(scenarios: list[str]) -> Iterator[tuple[str, pl.Expr]]:
    """The rows of a table, and which of its pairs are theirs."""
    # Without the pairs in which the traditional robot does not achieve the goal.
    unfailing = pl.col("correct").fill_null(False) | pl.col("lost")
    everything = pl.col("row").is_in(SCENARIOS)
    for name in scenarios:
        yield name, pl.col("row") == name
    yield ALL, everything
    for name in ("3", "4"):
        yield name + NO_FAILURES, (pl.col("row") == name) & unfailing
    yield ALL + NO_FAILURES, everything & unfailing


def _row(name: str, sample: Sample, robots: Compared) -> Row:
    reasons = Counter(sample.pairs["apart"])
    counted = sample.where(~pl.col("apart").is_in(list(LEFT_OUT.values())).fill_null(False))
    pairs, decided, ended = counted.pairs, counted.decided, counted.ended
    own, base = (pl.col(name).cast(pl.Int8) for name in ("correct" + OTHER, "correct"))
    return Row(
        name=name,
        pairs=len(pairs),
        left_out={key: reasons[reason] for key, reason in LEFT_OUT.items()},
        out_of_reach=len(pairs.filter(pl.col("out_of_reach") | pl.col("out_of_reach" + OTHER))),
        meetings=dict(sorted(Counter(pairs["meeting"]).items())),
        undecided=len(pairs) - len(decided.pairs),
        baseline=decided.share("correct"),
        treatment=decided.share("correct" + OTHER),
        accuracy=decided.mcnemar("correct"),
        advantage=decided.mean(own - base),
        ratios={measure: ended.ratio(measure) for measure in MEASURES},
        optimum={
            robots.treatment: optimum(ended.pairs, OTHER, "weight"),
            robots.baseline: optimum(ended.pairs, "", "weight"),
        },
        times={name: _seconds(ended, name) for name in TIMES},
        whole=sample.whole,
    )


def _seconds(sample: Sample, name: str) -> Seconds:
    """Beside the published measures: what is tested is one of these, or not."""
    weight = pl.col("weight")
    means = {who: (weight * pl.col(name + who)).sum() / weight.sum() for who in ("", OTHER)}
    base, own = sample.pairs.select(**means).fill_nan(None).row(0)
    return Seconds(base, own, replace(sample.ratio(name), test=None))
