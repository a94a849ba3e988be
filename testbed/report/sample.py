"""Which trials a page holds of a run: pairs with failures, then some of every condition."""

from collections.abc import Iterator, Sequence

import polars as pl

from testbed.analysis.table import Trials
from testbed.report.stories import WRONG

MOST_TRIALS = 400
"""Trials that a page holds."""
MOST_FAILED = 300
"""Of these, trials of pairs in which one failed, where there are others."""
PLACE = ("cell", "scenario", "level")
PAIR = ("cell", "pair")


def pairs_of(trials: Trials, place: Sequence[str] = PLACE) -> pl.DataFrame:
    """One row per pair under a condition, in the order in which a page shows them.

    `trials` are the ids of its trials, `failed` says whether one of them is not correct. Pairs in
    which one is come first; both parts go through the conditions, scenarios and levels, which are
    the columns of a `place`, and the robots that failed, in turn. Which pairs of one of these come
    first is as if drawn, for the ids of pairs are hashes, and the same in each report of a run.
    """
    wrong = WRONG | ~pl.col("achieved")
    pairs = (
        trials.lazy()
        .group_by(*place, "pair", maintain_order=True)
        .agg(
            trials="trial",
            failed=wrong.any(),
            losers=pl.col("robot").filter(wrong).sort().str.join(),
        )
        .collect()
    )
    turn = pl.int_range(pl.len()).over(*place, "losers", order_by="pair")
    return pairs.with_columns(turn=turn).sort(pl.col("failed").not_(), "turn", maintain_order=True)


def sampled(trials: Trials) -> Iterator[Sequence[str]]:
    """The ids of the trials of a page, pair by pair."""
    pairs = pairs_of(trials).with_columns(size=pl.col("trials").list.len())
    failed, others = pairs.filter("failed"), pairs.filter(~pl.col("failed"))
    room = max(MOST_FAILED, MOST_TRIALS - others["size"].sum())
    kept = failed.filter(pl.col("size").cum_sum() <= room)
    chosen = pl.concat([kept, others])
    yield from chosen.filter(pl.col("size").cum_sum() <= MOST_TRIALS)["trials"].to_list()
