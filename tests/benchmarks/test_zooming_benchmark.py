"""Zooming against no zooming, at its smallest size."""

from pathlib import Path

import pytest

from asp.domains import LevelSize
from benchmarks import zooming
from benchmarks.fine_problems import drawn, refined
from tests.benchmarks.late import takes_too_long


@pytest.mark.usefixtures("own_heap")
def test_every_point_is_measured_on_all_sides(tmp_path: Path) -> None:
    levels, cells, objects = zooming.main("small")
    assert [row["level"] for row in levels.rows] == list(zooming.NAMES["small"])
    assert [row["cells"] for row in cells.rows] == [edge**2 for edge in zooming.EDGES["small"]]
    assert [row["objects"] for row in objects.rows] == list(zooming.OBJECTS["small"])
    for side in ("zoom", "whole", "literal_zoom", "literal_whole", "last_zoom", "last_whole"):
        assert all(isinstance(row[f"{side}_ms"], float) for row in levels.rows)
    zooming.draw([levels, cells, objects], tmp_path / "zooming.png")
    assert (tmp_path / "zooming.png").read_bytes().startswith(b"\x89PNG")


def test_the_literal_translation_is_given_up_in_time(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(zooming, "within", takes_too_long)
    problems = drawn(refined(LevelSize(2, 1, 2, ((1, 1),))), 1, seed=2)
    assert zooming.literal(problems, "literal_zoom", 100.0) == "> 100 s"
