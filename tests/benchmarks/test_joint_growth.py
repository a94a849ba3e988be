"""The comparison of TI with ATI, at its smallest size."""

from pathlib import Path

from benchmarks.joint_growth import SIDES, draw, measure


def test_all_sides_answer_every_question_and_are_drawn(tmp_path: Path) -> None:
    sheets = measure((3, 4), (2, 3))
    assert [sheet.name for sheet in sheets] == ["history", "plan"]
    assert [row["steps"] for row in sheets[0].rows] == [3, 4]
    assert [row["actions"] for row in sheets[1].rows] == [2, 3]
    times = [row[side] for sheet in sheets for row in sheet.rows for side in SIDES]
    assert all(isinstance(time, float) for time in times)
    draw(sheets, tmp_path / "figure.png")
    assert (tmp_path / "figure.png").read_bytes().startswith(b"\x89PNG")


def test_a_side_that_takes_too_long_is_asked_no_more() -> None:
    history, _ = measure((3, 4), (2,), limit_s=1e-6)
    for side in SIDES:
        first, second = (row[side] for row in history.rows)
        assert (first, second) == ("> 0 s", None)
