"""Two robots of a run compared: which pairs count, their accuracy, ratios and tests."""

from collections.abc import Collection, Mapping
from enum import StrEnum
from typing import Any

import polars as pl

from testbed.analysis import explanations, quality
from testbed.analysis.pairs import Compared
from testbed.analysis.run import Run
from testbed.analysis.table import Trials
from testbed.config import ExperimentConfig
from testbed.experiment.record import FAILURES
from testbed.world import load_world


class Apart(StrEnum):
    """Why a pair is not compared; in `summary.json` such pairs are counted under the names."""

    INCOMPLETE = "incomplete"
    FAILED_PAIRS = "lost"
    DEADLINE = "deadline"
    UNSOLVABLE = "unsolvable"
    NOTHING_TO_DO = "nothing to do"
    WITHOUT_EVENT = "no event"


COUNTS: Mapping[Apart, str] = {reason: reason.name.lower() for reason in Apart}
"""The keys under which pairs are counted apart."""
ACCURACY = "accuracy"
KEPT = ("trial", "pair", "cell", "scenario", "level", "robot", "achieved", "correct", "outcome")
"""The columns of a table that its measured trials have as well."""

MEASURES: Mapping[str, pl.Expr] = {
    "total_time": pl.col("planning_cpu_s") + pl.col("execution_units"),
    "plans": pl.col("plans"),
    "planning_time": pl.col("planning_cpu_s"),
    "execution_units": pl.col("execution_units"),
    "actions": pl.col("action_count"),
}
"""What the tests compare; times are process time, which a loaded machine does not stretch."""
TIMES: Mapping[str, pl.Expr] = {
    "planning_time": pl.col("planning_cpu_s"),
    "diagnosis_time": pl.col("diagnosis_cpu_s"),
    "reasoning_time": pl.col("planning_cpu_s") + pl.col("diagnosis_cpu_s"),
}
"""Planning, diagnosis, and both."""
DIVIDED: Mapping[str, pl.Expr] = {**MEASURES, **TIMES}
"""What is divided in a pair; of these the tests compare `MEASURES` alone."""
LEAST: Mapping[str, str] = {"execution_units": "minimal_units", "actions": "minimal_actions"}
"""The measures of which the least that achieves the goal is known, and the column that has it."""


def compared(config: ExperimentConfig) -> tuple[Compared, ...]:
    """The comparisons of a configuration, the main one first; of a single robot one with ""."""
    asked = tuple(Compared(*robots) for robots in config.comparisons)
    return asked or (Compared("", config.robots[0]),)


def measured(trials: Trials) -> pl.DataFrame:
    """Of each trial of a table what comparisons need, by columns.

    `lost`: something other than its robot ended it; `late`: a decision was cut off by the clock;
    `unproved_steps`: as in the record; `ended`: it came to its end without an error; `solvable`:
    some plan achieves the goal, or none is known not to; `idle`: the goal held from the start on,
    and nothing was done; `quiet`: nothing
    exogenous happened; `out_of_reach`: the goal could not be achieved any more at the end. A trial
    that the robot's own error ended is neither idle nor quiet: what it would have been is not
    known. `state` names the initial state, `told` is the number of explanations. The other columns
    are `DIVIDED`, and those of how well the robot explained: what is counted, and the shares and
    means.
    """
    failure, own = pl.col("outcome").is_in(FAILURES), pl.col("cause").eq_missing("robot")
    still = (pl.col("activities").list.len() == 0) & (pl.col("actions").list.len() == 0)
    failed = failure & own
    query = trials.lazy().select(
        *KEPT,
        *LEAST.values(),
        "oracle_units",
        lost=failure & ~own,
        late=pl.col("deadline"),
        unproved_steps=pl.col("unproved_steps"),
        out_of_reach=pl.col("in_reach").eq_missing(False),
        ended=~failure,
        solvable=pl.col("minimal_actions").is_not_null()
        | pl.col("minimal_reason").eq_missing("budget"),
        idle=pl.col("achieved") & still & ~failed,
        quiet=(pl.col("exogenous").list.len() == 0) & ~failed,
        state=pl.col("initial").list.join(" "),
        told=pl.col("explanations").list.len(),
        **{name: measure.cast(pl.Float64) for name, measure in DIVIDED.items()},
        **{
            name: pl.col(name).cast(pl.Int32 if kind is int else pl.Float64)  # counts are small
            for name, kind in explanations.KINDS.items()
        },
        **quality.values(),
    )
    return query.collect()


def by_condition(run: Run) -> dict[str, pl.DataFrame]:
    """The measured trials of a run under each condition of its sweep, by name."""
    rows = measured(run.table)
    found = rows.partition_by("cell", as_dict=True)
    return {name: found.get((name,), rows.clear()) for name in run.conditions}


def eventful(config: ExperimentConfig) -> frozenset[str]:
    """The scenarios in which something exogenous is to happen: a pair without it is not theirs.

    These are the scenarios with a script that is not empty, and those with a trigger that the
    domain does not leave to chance; in one that it does, nothing is among what may happen.
    """
    if config.is_fine:
        return frozenset()
    triggers = load_world(config.domain).description.triggers
    certain = {trigger.scenario for trigger in triggers if trigger.probability == 1.0}
    sure: set[str] = certain if config.plays_triggers else set()
    scripts = {name: config.settings(name).script for name in config.scenarios}
    return frozenset(
        n for n, script in scripts.items() if (n in sure if script is None else script)
    )


def with_apart(trials: pl.DataFrame, robots: Compared, sure: Collection[str]) -> pl.DataFrame:
    """Measured trials with the column `apart`: why their pair is not compared; null if it is.

    A pair must have the trials of both robots, as far as these are on record at all. The
    treatment's trial says whether there was something to do, and whether the event fired: others
    see the same events only as long as they act like it. Without it all trials of the pair do.
    `sure` are the eventful scenarios.
    """
    known = trials["robot"].unique().to_list()
    needed = [name for name in robots if name in known] or known
    own, judge = pl.col("robot").is_in(needed), pl.col("robot") == robots.treatment

    def judged(name: str) -> pl.Expr:
        return pl.when(judge.any()).then((pl.col(name) & judge).any()).otherwise(pl.col(name).all())

    reasons = {
        Apart.INCOMPLETE: own.sum() < len(needed),
        Apart.FAILED_PAIRS: (pl.col("lost") & own).any(),
        Apart.DEADLINE: (pl.col("late") & own).any(),
        Apart.UNSOLVABLE: (~pl.col("solvable") & own).any(),
        Apart.NOTHING_TO_DO: judged("idle"),
        Apart.WITHOUT_EVENT: judged("quiet") & pl.col("scenario").first().is_in(list(sure)),
    }
    told = [pl.when(holds).then(pl.lit(reason)) for reason, holds in reasons.items()]
    pairs = trials.group_by("pair").agg(apart=pl.coalesce(*told, pl.lit(None, pl.String)))
    return trials.join(pairs, on="pair", maintain_order="left")


def optimum(trials: pl.DataFrame, who: str = "", weight: str | None = None) -> dict[str, Any]:
    """How far trials are from the least that achieves the goal: what was needed divided by it.

    Means by measure, over `trials` that achieved the goal, of pairs those of one robot. The least
    is what a search with complete knowledge finds from the initial state where nothing exogenous
    happens: below 1 is who was helped on the way. Trials whose least is not known, or 0, are left
    out.
    """
    achieved = trials.filter("achieved" + who, "ended" + who)
    known = achieved.filter(pl.col(least) > 0 for least in LEAST.values())
    weights = pl.ones(pl.len()) if weight is None else pl.col(weight)
    means = {
        name: (weights * pl.col(name + who) / pl.col(least)).sum() / weights.sum()
        for name, least in LEAST.items()
    }
    return known.select(trials=pl.len(), **means).fill_nan(None).row(0, named=True)
