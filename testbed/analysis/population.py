"""Scenarios of which the whole population is played: what they come to has no interval."""

import polars as pl

from testbed.analysis.run import Run
from testbed.experiment.plan import enumerated
from testbed.experiment.record import FAILURES


def exhausted(run: Run) -> frozenset[str]:
    """The scenarios that are exhausted under each condition of a run."""
    return frozenset.intersection(*exhausted_under(run).values())


def exhausted_under(run: Run) -> dict[str, frozenset[str]]:
    """By condition the scenarios that were played from all initial states, with nothing drawn.

    One with a trial that is not on record, that something other than its robot ended, or that the
    clock cut off, is none of them.
    """
    lost = pl.col("outcome").is_in(FAILURES) & pl.col("cause").ne_missing("robot")
    kept = run.table.filter(~lost, ~pl.col("deadline"))
    played = {tuple(own): n for *own, n in kept.group_by("cell", "scenario").len().collect().rows()}
    return {
        cell: frozenset(n for n, whole in enumerated(own).items() if played.get((cell, n)) == whole)
        for cell, own in run.conditions.items()
    }
