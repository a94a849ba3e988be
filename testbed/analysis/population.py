"""Scenarios of which the whole population is played: what they come to has no interval."""

import polars as pl

from testbed.analysis.table import Run
from testbed.experiment.plan import enumerated
from testbed.experiment.record import FAILURES


def exhausted(run: Run) -> frozenset[str]:
    """The scenarios that were played from all of their initial states, with nothing drawn.

    Of a sweep these are the scenarios of which this holds under each condition. One with a trial
    that is not on record, that something other than its robot ended, or that the clock cut off,
    is none of them.
    """
    if run.config.is_sweep:
        return frozenset.intersection(*map(exhausted, run.conditions.values()))
    lost = pl.col("outcome").is_in(FAILURES) & pl.col("cause").ne_missing("robot")
    played = run.trials.filter(~lost, ~pl.col("deadline")).group_by("scenario").len()
    whole = enumerated(run.config)
    return frozenset(name for name, number in played.iter_rows() if whole.get(name) == number)
