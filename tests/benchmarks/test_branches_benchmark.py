"""Branches of a trial that are explored by snapshots are those that are found by replaying."""

import pytest

from benchmarks import branches


@pytest.mark.usefixtures("own_heap")
def test_both_ways_find_the_same_branches() -> None:
    (sheet,) = branches.main("small")
    assert [row["robot"] for row in sheet.rows] == [
        *["intentional"] * 2,
        *["traditional"] * 2,
        *["intentional"] * 2,
    ]
    assert all(row["branches"] for row in sheet.rows)
