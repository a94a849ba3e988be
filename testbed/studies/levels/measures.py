"""The columns of Tables 2 and 3 (P 4): reasoning of the trials of a level, by robot, compared."""

from collections.abc import Mapping
from dataclasses import dataclass
from statistics import fmean, median, stdev

import polars as pl

from testbed.analysis import Run
from testbed.analysis.bootstrap import Estimate, bootstrap, means, medians, sample_of
from testbed.analysis.comparison import measured
from testbed.analysis.pairs import OTHER, Compared, Ratio, Sample, corrected, pairs_of
from testbed.analysis.statistics import Test
from testbed.studies.levels.published import FIRST, NO_ZOOM, OWN, PAPER, PARTS, ZOOM, Paper

ROBOTS = Compared(NO_ZOOM, ZOOM)
WORK = ("refined_plans", "concrete_actions")
Trials = Mapping[str, pl.DataFrame]
"""Those of a level, by robot."""


@dataclass(frozen=True)
class Spread:
    """Mean, standard deviation and median of a sample."""

    mean: float
    sd: float
    median: float


@dataclass(frozen=True)
class Reasoning:
    """One robot at a level: how its trials ended, what it did in them; times are seconds.

    Trials that the robot's own error ended count as trials, and as not completed; those that
    something else ended are not among them.
    """

    trials: int
    achieved: int
    out_of_reach: int
    completed: float
    refined_plans: Spread | None
    concrete_actions: Spread | None
    total: Spread | None
    fine: Spread | None
    coarse: Spread | None
    refined_plan: Spread | None


@dataclass(frozen=True)
class Growth:
    """How many times the mean and the median at the first level a time has at this one."""

    mean: Estimate | None
    median: Estimate | None


@dataclass(frozen=True)
class Comparison:
    """What can be compared across machines: shares, by robot; ratios, by part; growth, by both.

    A ratio is a time without zooming, divided by that with it, over the pairs of which both trials
    achieved their goal. The tests of shares are McNemar's, of `pairs` that both robots played;
    their effect is above 0 where the one that zooms achieved its goal, or was correct, more often.
    """

    pairs: int
    completed: Mapping[str, Estimate]
    correct: Mapping[str, Estimate]
    ratios: Mapping[str, Ratio]
    growth: Mapping[str, Mapping[str, Growth]]
    completed_test: Test | None
    correct_test: Test | None


@dataclass(frozen=True)
class Level:
    """The columns of a level: `reasoning` by robot, `zoom_ratios` (the means), what is compared."""

    reasoning: Mapping[str, Reasoning]
    zoom_ratios: Mapping[str, float | None]
    compared: Comparison


@dataclass(frozen=True)
class Levels:
    """The columns by level, and what they are to be compared with."""

    levels: Mapping[str, Level]
    paper: Paper = OWN


def measures(run: Run, as_published: bool) -> Levels | None:
    """The columns of the levels of a run."""
    levels = analyse(run.trials)
    return Levels(levels, PAPER if as_published else OWN) if levels else None


def fine_trials(trials: pl.DataFrame) -> pl.DataFrame:
    """The trials at levels, `measured`, with their seconds of process time by PARTS.

    They are those of a whole trial: `coarse` is planning and diagnosis, `fine` refined plans and
    the inference of what came of them, `total` both; `refined_plan` is the mean time of one of
    them, null where none was made. `refined_plans`, `concrete_actions` and `tests` are numbers.
    """
    own = pl.col("fine").struct
    coarse = pl.col("planning_cpu_s") + pl.col("diagnosis_cpu_s")
    fine = own.field("planning_cpu_s") + own.field("infer_cpu_s")
    plans = own.field("plans")
    columns = trials.select(
        total=fine + coarse,
        fine=fine,
        coarse=coarse,
        refined_plan=pl.when(plans > 0).then(own.field("planning_cpu_s") / plans),
        refined_plans=plans,
        concrete_actions=own.field("actions"),
        tests=own.field("tests"),
    )
    rows = measured(trials).hstack(columns).drop_nulls("fine")
    return rows.with_columns(achieved=pl.col("achieved") & pl.col("ended"))


def analyse(trials: pl.DataFrame) -> dict[str, Level]:
    """The columns of each level; p-values are corrected over the tests of all of them."""
    counted = fine_trials(trials).filter(~pl.col("lost"), ~pl.col("late"))
    levels = counted.partition_by("level", as_dict=True, maintain_order=True)
    first = _by_robot(levels[(FIRST,)]) if (FIRST,) in levels else {}
    return corrected({str(name): _level(own, first) for (name,), own in levels.items()})


def _by_robot(trials: pl.DataFrame) -> Trials:
    """The two conditions first, other robots as they come."""
    groups = trials.partition_by("robot", as_dict=True, maintain_order=True)
    order = [(ZOOM,), (NO_ZOOM,), *groups]
    return {str(name): groups[name,] for (name,) in dict.fromkeys(order) if (name,) in groups}


def _level(trials: pl.DataFrame, first: Trials) -> Level:
    robots = _by_robot(trials)
    pairs = Sample(pairs_of(trials, ROBOTS).sort("number" + OTHER), cluster=None)
    ended = pairs.where("achieved", "achieved" + OTHER)
    # Of the pairs that have this part of the time.
    ratios = {
        part: ended.where(pl.col(part).is_not_null(), pl.col(part + OTHER) > 0).ratio(part)
        for part in PARTS
    }
    compared = Comparison(
        pairs=len(pairs.pairs),
        completed=_shares(robots, "achieved"),
        correct=_shares(robots, "correct"),
        ratios=ratios,
        growth={} if trials["level"][0] == FIRST else _growth(robots, first),
        completed_test=pairs.mcnemar("achieved"),
        correct_test=pairs.decided.mcnemar("correct"),
    )
    means = {part: None if r.mean is None else r.mean.value for part, r in ratios.items()}
    return Level({robot: _reasoning(own) for robot, own in robots.items()}, means, compared)


def _reasoning(trials: pl.DataFrame) -> Reasoning:
    achieved, played = len(trials.filter("achieved")), trials.filter("ended")
    return Reasoning(
        trials=len(trials),
        achieved=achieved,
        out_of_reach=len(trials.filter("out_of_reach")),
        completed=achieved / len(trials),
        **{name: _spread(played[name].drop_nulls()) for name in (*WORK, *PARTS)},
    )


def _spread(values: pl.Series) -> Spread | None:
    """None of nothing."""
    if not len(values):
        return None
    return Spread(fmean(values), stdev(values) if len(values) > 1 else 0.0, median(values))


def _shares(robots: Trials, holds: str) -> dict[str, Estimate]:
    """Of the trials of which it is known."""
    shares = {robot: Sample(own, cluster=None).share(holds) for robot, own in robots.items()}
    return {robot: share for robot, share in shares.items() if share is not None}


def _growth(robots: Trials, first: Trials) -> dict[str, dict[str, Growth]]:
    """By robot and part of the time; nothing for a robot that did not play the first level."""
    return {
        robot: {part: _times(own, first[robot], part) for part in PARTS}
        for robot, own in robots.items()
        if robot in first
    }


def _times(trials: pl.DataFrame, first: pl.DataFrame, part: str) -> Growth:
    above, below = (
        sample_of(own.filter("ended")[part].drop_nulls().to_numpy()) for own in (trials, first)
    )
    return Growth(bootstrap(means, above, below), bootstrap(medians, above, below))
