"""Trials in random refinements of random domains, at the smallest size."""

from benchmarks.refinements import TRIALS, main


def test_every_trial_is_counted_and_none_fails() -> None:
    (sheet,) = main("small")
    counts = [row[end] for row in sheet.rows for end in ("refused", "achieved", "out_of_reach")]
    assert sum(int(count or 0) for count in counts) == TRIALS["small"]
    assert {row["failed"] for row in sheet.rows} == {0}
