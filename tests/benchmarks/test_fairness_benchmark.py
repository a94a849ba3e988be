"""Fair events by the size of an office, at the smallest size."""

from benchmarks import fairness


def test_events_are_found_in_each_office() -> None:
    (sheet,) = fairness.main("small")
    assert [(row["books"], row["rooms"]) for row in sheet.rows] == [*fairness.OFFICES["small"]]
    for row in sheet.rows:
        assert row["fair_events"] == row["any_events"] > 0  # a robot can put right all that happens
        assert all(isinstance(row[f"{name}_ms"], float) for name in ("any", "fair"))
