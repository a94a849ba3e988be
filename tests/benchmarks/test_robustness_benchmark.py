"""Each search of the benchmark plays, and nothing is found with one event."""

from benchmarks import robustness


def test_each_search_plays_and_finds_nothing_with_one_event() -> None:
    played, kinds = robustness.main("small")
    assert {row["search"] for row in played.rows} == {*robustness.HUNTS}
    assert {row["events"] for row in played.rows} == {0, 1}
    assert all(row["with_findings"] == 0 for row in played.rows)
    assert not kinds.rows
