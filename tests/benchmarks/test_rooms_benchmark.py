"""Controls for one problem beside controls that are kept, at the smallest size."""

from benchmarks import rooms


def test_both_kinds_are_measured() -> None:
    (sheet,) = rooms.main("small")
    assert [row["cells"] for row in sheet.rows] == [edge**2 for edge in rooms.EDGES["small"]]
    for column in ("own_first_s", "own_ms", "kept_first_s", "kept_ms", "first_times"):
        assert all(isinstance(row[column], float) for row in sheet.rows)
